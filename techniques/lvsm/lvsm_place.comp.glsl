// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/lvsm/lvsm.shared.h"

// Where the layers meet: Lloyd's relaxation of cluster means over the histogram of depths (Lauritzen and McCool 2008, section 4), in a
// few thousand steps of one invocation, since sums over a stretch of depth are differences of two prefix sums.
layout(local_size_x = 1) in;

layout(set = 0, binding = 0, scalar) readonly buffer Histogram { uint counts[LVSM_BINS]; };
layout(set = 0, binding = 1, scalar) buffer Bounds { float bounds[LVSM_MAX_LAYERS + 1]; };
layout(set = 1, binding = 0, scalar) uniform Constants { PlaceConstants c; };

shared float number[LVSM_BINS + 1]; // of texels before a bin
shared float total[LVSM_BINS + 1]; // of their bins' centres

float number_at(float bin) { return mix(number[int(bin)], number[min(int(bin) + 1, LVSM_BINS)], fract(bin)); }
float total_at(float bin) { return mix(total[int(bin)], total[min(int(bin) + 1, LVSM_BINS)], fract(bin)); }

void main()
{
    number[0] = total[0] = 0.0;
    int first = LVSM_BINS, last = -1;
    for (int i = 0; i < LVSM_BINS; ++i) {
        number[i + 1] = number[i] + float(counts[i]);
        total[i + 1] = total[i] + float(counts[i]) * (float(i) + 0.5);
        if (counts[i] > 0) first = min(first, i), last = i;
    }
    const int layers = c.params.layers;
    // Relaxation begins with even layers over the depths that occur. Where they hardly differ, over the whole range instead: a layer not
    // much wider than the least deviation bounds nothing.
    if (last - first < 4 * layers || c.params.split == 0) first = 0, last = LVSM_BINS - 1;
    float edge[LVSM_MAX_LAYERS + 1];
    for (int i = 0; i <= layers; ++i) edge[i] = mix(float(first), float(last + 1), float(i) / float(layers));
    const int rounds = c.params.split == 0 ? 0 : 32;
    for (int round = 0; round < rounds; ++round) {
        float before = 0.0;
        for (int i = 0; i < layers; ++i) {
            const float n = number_at(edge[i + 1]) - number_at(edge[i]);
            const float mean = n > 0.5 ? (total_at(edge[i + 1]) - total_at(edge[i])) / n : 0.5 * (edge[i] + edge[i + 1]);
            if (i > 0) edge[i] = 0.5 * (before + mean);
            before = mean;
        }
    }
    for (int i = 0; i <= layers; ++i) bounds[i] = 2.0 * edge[i] / float(LVSM_BINS) - 1.0;
    if (c.params.split == 0) return;
    bounds[0] = -1.0;
    bounds[layers] = 1.0;
}
