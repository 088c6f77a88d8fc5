// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SDSM_SAMPLE_GLSL
#define GNOMON_SDSM_SAMPLE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/receiver.glsl"
#include "src/shadow/parts/sdsm.shared.h"

// What the receiver of a pixel is measured by: the distance that cascades are chosen by (shaders/light_map.glsl), and where it lies for the
// light.
vec4 sample_of(SdsmReduce c, ivec2 pixel, float depth)
{
    const vec3 p = world_from_depth(c.view, vec2(pixel) + 0.5, depth);
    return vec4(dot(p - c.view.eye, c.view.forward), (c.light_axes * vec4(p, 1.0)).xyz);
}

#endif
