// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/moment_soft/moment_soft.shared.h"

#define Sums uvec4
#include "techniques/moment_soft/moment_soft_resolve.glsl"

layout(set = 0, binding = 4) uniform usampler2DArray sums_image;

uvec4 sums_at(ivec2 entry) { return texelFetch(sums_image, ivec3(entry, point.layer), 0); }
ivec2 texels_of_map() { return textureSize(sums_image, 0).xy - 1; }
vec4 moments_from_mean(vec4 stored) { return moments_from_quantised(c.prefiltered.sum_step * stored); }
