// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/octahedral.glsl"
#include "shaders/scene.glsl"
#include "src/shadow/gbuffer.shared.h"

layout(location = 0) in vec3 position;
layout(location = 1) in uint normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in uint color;

layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { GBufferConstants c; };

layout(location = 0) out vec3 p_eye; // world axes, origin at the eye: keeps derivatives exact far from the world's origin
layout(location = 1) out vec3 n_world;
layout(location = 2) out vec2 uv_out;
layout(location = 3) out vec4 color_out;
layout(location = 4) flat out uvec2 ids; // first primitive, material

invariant gl_Position; // the motion pass finds these depths again

void main()
{
    const uint slot = instance_slot(gl_InstanceIndex);
    const Instance i = instances[slot];
    ids = uvec2(i.first_primitive, i.material);
    const vec3 p_world = transform_point(i, position);
    gl_Position = c.view.clip_from_world * vec4(p_world, 1.0);
    p_eye = p_world - c.view.eye;
    n_world = transform_normal(i, decode_normal(normal));
    uv_out = uv;
    color_out = unpackUnorm4x8(color);
}
