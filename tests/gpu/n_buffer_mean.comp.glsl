// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/n_buffer.glsl"
#include "tests/gpu/windows.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { WindowCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { vec4 results[]; };
layout(set = 0, binding = 2) uniform sampler2DArray image;
layout(set = 1, binding = 0, scalar) uniform Constants { NBuffer b; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= cases.length()) return;
    const WindowCase c = cases[i];
    results[i] = mean_square(image, b, c.layer, 0.5 * (c.lo + c.hi), c.hi.x - c.lo.x);
}
