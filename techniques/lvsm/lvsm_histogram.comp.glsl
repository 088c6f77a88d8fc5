// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/lvsm/lvsm.shared.h"

// How many texels of one layer of the map lie at each depth. Empty ones are no surfaces and do not count.
layout(local_size_x = 16, local_size_y = 16) in;

layout(set = 0, binding = 1, scalar) buffer Histogram { uint counts[LVSM_BINS]; };
layout(set = 1, binding = 0, scalar) uniform Constants { HistogramConstants c; };

shared uint own[LVSM_BINS];

void main()
{
    for (uint i = gl_LocalInvocationIndex; i < LVSM_BINS; i += 256) own[i] = 0;
    barrier();
    // each group counts 64 x 64 texels, so that its own bins are worth emptying
    const ivec2 size = textureSize(depth_map, 0).xy;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const ivec2 texel = ivec2(gl_WorkGroupID.xy) * 64 + ivec2(x, y) * 16 + ivec2(gl_LocalInvocationID.xy);
            if (any(greaterThanEqual(texel, size)) || fetch_depth(depth_map, c.map.index, texel) == 0.0) continue;
            const int bin = int((0.5 + 0.5 * centred_depth(c.map, texel)) * LVSM_BINS);
            atomicAdd(own[clamp(bin, 0, LVSM_BINS - 1)], 1);
        }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < LVSM_BINS; i += 256)
        if (own[i] > 0) atomicAdd(counts[i], own[i]);
}
