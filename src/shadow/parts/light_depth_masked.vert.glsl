// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "shaders/scene.glsl"
#include "src/shadow/parts/light_depth.shared.h"

layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
layout(location = 3) in uint color;
layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { LightDepthConstants c; };

layout(location = 0) out vec3 uv_alpha;
layout(location = 1) flat out uint material;
layout(location = 2) flat out int layer;

void main()
{
    const uint slot = instance_slot(gl_InstanceIndex);
    gl_Layer = layer = instance_layer(gl_InstanceIndex);
    gl_Position = c.clip_from_world[gl_Layer] * vec4(transform_point(instances[slot], position), 1.0);
    uv_alpha = vec3(uv, unpackUnorm4x8(color).a);
    material = instances[slot].material;
}
