// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/blurred_depth/blurred_depth.shared.h"

#include "shaders/filter_resolve.glsl"

float filtered_visibility(FilterPoint at)
{
    const LightMapLayer layer = c.filtering.map.layers[at.layer];
    const float behind = 0.5 * (at.t - window_mean(at, 0).x) * (layer.far - layer.near); // metres
    // Luft and Deussen's comparison, or the step that it softens
    return c.params.compare != 0 ? 1.0 - smoothstep(0.0, c.params.softness, behind) : behind > 0.0 ? 0.0 : 1.0;
}
