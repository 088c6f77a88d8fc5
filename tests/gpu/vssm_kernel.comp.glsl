// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vssm/vssm_kernel.glsl"
#include "tests/gpu/vssm_kernel.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { KernelCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { KernelResult results[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Extra { float depths[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

KernelCase kernel;

float receiver_depth(vec2 at) { return kernel.t + dot(kernel.slope, at); }

float texel_depth(ivec2 texel)
{
    const ivec2 at = clamp(texel, 0, VSSM_FIELD - 1);
    return depths[(kernel.field * VSSM_FIELD + at.y) * VSSM_FIELD + at.x];
}

vec2 window_moments(vec2 lo, vec2 hi)
{
    vec3 sum = vec3(0.0);
    for (int y = int(floor(lo.y)); float(y) < hi.y; ++y)
        for (int x = int(floor(lo.x)); float(x) < hi.x; ++x) {
            const vec2 covered = min(vec2(x, y) + 1.0, hi) - max(vec2(x, y), lo);
            const float z = texel_depth(ivec2(x, y));
            sum += covered.x * covered.y * vec3(1.0, z, z * z);
        }
    return sum.yz / sum.x;
}

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= count) return;
    kernel = cases[index];
    KernelSettings k = KernelSettings(kernel.flat_deviation * kernel.flat_deviation, kernel.min_deviation * kernel.min_deviation,
        kernel.slope, kernel.grid, kernel.height, kernel.per_cell != 0);
    const Evidence e = weigh_kernel(k, kernel.lo, kernel.hi, kernel.subdivision);
    KernelResult r;
    r.area = e.lit + e.bounded.x + e.compared.x;
    r.compared = e.compared.x;
    r.blocker = kernel_blocker(e, k);
    k.per_cell = false;
    r.pooled = kernel_visibility(e, k, 0.0);
    k.per_cell = true;
    r.per_cell = kernel_visibility(e, k, 0.0);
    results[index] = r;
}
