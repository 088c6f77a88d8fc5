// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/sdsm.glsl"

// Where cascades end, between the nearest and the furthest sample: parts::cascade_ends and fit_cascades.
layout(local_size_x = 1) in;
layout(set = 0, binding = 0, scalar) buffer Fitted { FittedMap fitted; };
layout(set = 1, binding = 0, scalar) uniform Constants { SdsmFit c; };

// Of one ratio, where cascades of a view with a horizon are concerned: with both ends known that is the best of all (cascade_split = 1).
float cascade_end(float near, float far, int i)
{
    const float part = float(i) / float(c.fallback.layer_count);
    if (c.near == 0.0) return near + part * (far - near);
    const float nearest = clamp(c.fitting.nearest, near, far);
    return nearest * pow(far / nearest, part);
}

void main()
{
    fitted.map = c.fallback;
    if (!any_sample(fitted.all)) return;
    float near = least(fitted.all, 0), far = most(fitted.all, 0);
    if (c.near > 0.0) near = max(near, c.near);
    far = max(far, near + 1e-5 * max(abs(near), abs(far)));
    const int count = int(c.fallback.layer_count);
    float begin = near, end = near;
    for (int i = 0; i < count; ++i) {
        const float start = end;
        end = i < count - 1 ? cascade_end(near, far, i + 1) : far;
        // Whoever chooses a sample's cascade may round its distance otherwise.
        const float slack = 1e-5 * max(abs(near), abs(far));
        fitted.ranges[i] = vec2(begin - slack, end + slack);
        begin = mix(end, start, c.fitting.blend);
        if (i < count - 1) fitted.map.splits[i >> 2][i & 3] = end, fitted.map.bands[i >> 2][i & 3] = begin;
    }
}
