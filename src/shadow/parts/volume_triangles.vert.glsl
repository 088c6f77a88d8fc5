// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "src/shadow/parts/caster_vertex.glsl"
#include "src/shadow/parts/light_depth.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { LightDepthConstants c; };
layout(location = 0) flat out uint slot;

void main()
{
    slot = instance_slot(gl_InstanceIndex);
    gl_Layer = instance_layer(gl_InstanceIndex);
    gl_Position = c.clip_from_world[gl_Layer] * caster_vertex(slot);
}
