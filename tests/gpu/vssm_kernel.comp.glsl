// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#define Sums uvec2
const int grid = 8;
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

// Of z and z^2 in fixed point, which wraps around where a kernel's parts do not.
const float counts = 2097152.0; // of 1

uvec2 sums_at(ivec2 entry)
{
    uvec2 sum = uvec2(0u);
    for (int y = 0; y < entry.y; ++y)
        for (int x = 0; x < entry.x; ++x) {
            const float z = texel_depth(ivec2(x, y));
            sum += uvec2(round(counts * vec2(1.0 + z, z * z)));
        }
    return sum;
}

ivec2 texels_of_map() { return ivec2(VSSM_FIELD); }
vec2 moments_from_mean(vec2 stored) { return stored / counts - vec2(1.0, 0.0); }

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= count) return;
    kernel = cases[index];
    KernelSettings k = KernelSettings(kernel.flat_deviation * kernel.flat_deviation, kernel.min_deviation * kernel.min_deviation,
        kernel.slope, kernel.height, kernel.per_cell != 0, false);
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
