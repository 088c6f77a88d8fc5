// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_sides.glsl"
#include "src/shadow/parts/volume_weights.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Caps { VolumeCap caps[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Weights { ivec4 weights[]; }; // by slot
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

layout(location = 0) flat out vec4 weight;
out float gl_ClipDistance[1];

// Casters between the light and the near plane, drawn where the light's rays through them meet it (Hornus et al. 2005): with N the
// height over the plane, those of L and x meet at N(x) L - N(L) x in homogeneous coordinates.
void main()
{
    const VolumeCap cap = caps[gl_VertexIndex / 3];
    const vec3 x = (gl_VertexIndex % 3 == 0 ? cap.a : gl_VertexIndex % 3 == 1 ? cap.b : cap.c) - c.view.eye;
    const bool sun = c.light.kind == LIGHT_DIRECTIONAL;
    const vec4 light = sun ? vec4(-c.light.direction, 0.0) : vec4(c.light.position - c.view.eye, 1.0);
    const float height = dot(c.view.forward, x) - c.view.near, of_light = dot(c.view.forward, light.xyz) - c.view.near * light.w;
    const float front = of_light < 0.0 ? 1.0 : -1.0;
    const vec4 met = front * (height * light - of_light * vec4(x, 1.0));
    gl_Position = c.view.clip_from_world * vec4(met.xyz + met.w * c.view.eye, met.w);
    gl_Position.z = 0.0;
    gl_ClipDistance[0] = -front * height;
    weight = weight_of(weights[cap.slot], 1);
}
