// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/cssm/cssm_kernel.glsl"
#include "tests/gpu/cssm_kernel.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { SeriesCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { SeriesResult results[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Extra { float depths[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

SeriesCase kernel;
Series series;

vec4 stored(vec4 v)
{
    const float steps = exp2(float(kernel.bits)) - 1.0;
    return kernel.bits == 0 ? v : 2.0 * round((0.5 + 0.5 * v) * steps) / steps - 1.0;
}

// Of waves times depth, of waves, or of depth.
vec4 window(int i, bool waves, bool depth, vec2 lo, vec2 hi)
{
    vec4 sum = vec4(0.0);
    for (int y = int(floor(lo.y)); float(y) < hi.y; ++y)
        for (int x = int(floor(lo.x)); float(x) < hi.x; ++x) {
            const vec2 covered = min(vec2(x, y) + 1.0, hi) - max(vec2(x, y), lo);
            const float z = depths[(kernel.field * CSSM_FIELD + y) * CSSM_FIELD + x];
            sum += covered.x * covered.y * stored((waves ? sines(wave_phase(series, z), i) : vec4(1.0)) * (depth ? z : 1.0));
        }
    return sum / ((hi.x - lo.x) * (hi.y - lo.y));
}

vec4 mean_waves(int i, vec2 lo, vec2 hi) { return window(i, true, false, lo, hi); }
vec4 mean_depth_waves(int i, vec2 lo, vec2 hi) { return window(i, true, true, lo, hi); }
float mean_depth(vec2 lo, vec2 hi) { return window(0, false, true, lo, hi).x; }

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= count) return;
    kernel = cases[index];
    series = Series(kernel.groups, kernel.scale, kernel.shift, kernel.fill);
    SeriesResult r;
    r.lit = lit_series(series, kernel.t, kernel.lo, kernel.hi);
    r.level = lit_level(series, kernel.t, kernel.z);
    r.levelled = above_level(r.lit, r.level);
    r.blocker = blocker_series(series, kernel.t, kernel.lo, kernel.hi, kernel.least);
    results[index] = r;
}
