// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/light_samples.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { HiddenCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { HiddenResult results[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Extra { uint light_samples[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Image { vec4 light_image[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

layout(constant_id = 0) const int words = 8;
layout(constant_id = 1) const bool textured = false;

#include "shaders/light_samples.glsl"

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    hide_nothing();
    for (int k = 0; k < 3; ++k) hide_rectangle(cases[i].rectangles[k].xy, cases[i].rectangles[k].zw);
    for (int k = 0; k < 8; ++k) results[i].mask[k] = hidden_samples[k];
    results[i].area = hidden_area;
    results[i].visible = visible_part();
    results[i].colors = textured ? visible_colors() : vec3(0.0);
    results[i].all = all_hidden() ? 1u : 0u;
}
