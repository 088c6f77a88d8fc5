// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/lvsm/lvsm.glsl"
#include "techniques/lvsm/lvsm.shared.h"

layout(set = 0, binding = 1, scalar) readonly buffer Bounds { float bounds[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec4 moments[LVSM_MAX_LAYERS / 2]; // of two layers each

void main()
{
    const float t = centred_depth(c.map, ivec2(gl_FragCoord.xy));
    for (int i = 0; i < LVSM_MAX_LAYERS / 2; ++i) {
        vec2 w;
        for (int k = 0; k < 2; ++k) {
            const int layer = min(2 * i + k, c.params.layers - 1);
            w[k] = layer_warp(t, bounds[layer], bounds[layer + 1], c.params.overlap);
        }
        moments[i] = stored_values(c.map, vec4(w.x, w.x * w.x, w.y, w.y * w.y));
    }
}
