// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vssm/vssm.shared.h"

#include "shaders/summed_area_table.glsl"
#define Sums vec2
#include "techniques/vssm/vssm_resolve.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray sums_image;

vec2 window_moments(vec2 lo, vec2 hi)
{
    return window_mean(sums_image, point.layer, lo, hi).xy;
}

vec2 sums_at(ivec2 entry) { return texelFetch(sums_image, ivec3(entry, point.layer), 0).xy; }
ivec2 texels_of_map() { return textureSize(sums_image, 0).xy - 1; }
vec2 moments_from_mean(vec2 stored) { return stored; }
