// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "shaders/scene.glsl"
#include "src/shadow/parts/light_depth.shared.h"

layout(location = 0) in vec3 position;
layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { LightDepthConstants c; };

layout(location = 2) flat out int layer;

void main()
{
    gl_Layer = layer = instance_layer(gl_InstanceIndex);
    gl_Position = c.clip_from_world[gl_Layer] * vec4(transform_point(instances[instance_slot(gl_InstanceIndex)], position), 1.0);
}
