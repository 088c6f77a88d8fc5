// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/anisotropic.glsl"
#include "tests/gpu/windows.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { FootprintCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { FootprintResult results[]; };
layout(set = 0, binding = 2) uniform sampler2DArray mips;

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= cases.length()) return;
    const FootprintCase c = cases[i];
    const vec2 size = vec2(textureSize(mips, 0).xy);
    const Footprint f = ellipse_footprint(c.uv_dx * size, c.uv_dy * size);
    results[i].major = f.major;
    results[i].minor = f.minor;
    results[i].mean = anisotropic_mean(mips, c.layer, c.uv, c.uv_dx, c.uv_dy, c.most);
    results[i].trilinear = textureLod(mips, vec3(c.uv, float(c.layer)), log2(max(length(f.major), 1.0)));
}
