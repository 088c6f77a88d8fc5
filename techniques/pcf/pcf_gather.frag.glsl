// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/receiver.glsl"
#include "techniques/pcf/pcf.shared.h"

// Interleaved sampling (Keller and Heidrich 2001): any k x k pixels hold all k x k groups of taps, so that their mean is the whole
// kernel. Pixels of another surface are left out: those with another normal, or off this pixel's plane.
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2D part_image;
layout(set = 1, binding = 0, scalar) uniform Constants { GatherConstants c; };

layout(location = 0) out float visibility;

void main()
{
    const Receiver r = load_receiver(c.view, depth_image, normal_image, gl_FragCoord.xy);
    visibility = 1.0;
    if (r.background) return;
    const ivec2 last = ivec2(c.view.size) - 1, corner = ivec2(gl_FragCoord.xy) - c.groups / 2;
    const float near_plane = float(c.groups) * pixel_metres(c.view, r.p_world);
    float sum = 0.0, weight = 0.0;
    for (int y = 0; y < c.groups; ++y)
        for (int x = 0; x < c.groups; ++x) {
            const ivec2 pixel = corner + ivec2(x, y);
            if (any(lessThan(pixel, ivec2(0))) || any(greaterThan(pixel, last))) continue;
            const Receiver other = load_receiver(c.view, depth_image, normal_image, vec2(pixel) + 0.5);
            const bool same = !other.background && dot(other.n_geometric, r.n_geometric) > 0.9
                && abs(dot(r.n_geometric, other.p_world - r.p_world)) < near_plane;
            const float w = same ? 1.0 : 0.0;
            sum += w * texelFetch(part_image, pixel, 0).r;
            weight += w;
        }
    visibility = sum / weight; // the pixel itself counts
}
