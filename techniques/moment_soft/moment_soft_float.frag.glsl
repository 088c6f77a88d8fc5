// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/moment_soft/moment_soft.shared.h"

#define Sums vec4
#include "techniques/moment_soft/moment_soft_resolve.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray sums_image;

vec4 sums_at(ivec2 entry) { return texelFetch(sums_image, ivec3(entry, point.layer), 0); }
ivec2 texels_of_map() { return textureSize(sums_image, 0).xy - 1; }
vec4 moments_from_mean(vec4 stored) { return stored; }
