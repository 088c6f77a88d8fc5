// SPDX-License-Identifier: Apache-2.0
// Four moments of a distribution of depths, and what shaders/moments.glsl makes of them.
#ifndef GNOMON_TESTS_MOMENTS_SHARED_H
#define GNOMON_TESTS_MOMENTS_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

struct MomentsCase {
    vec4 b;
    float t DEFAULT(0.0f);
    float bias DEFAULT(0.0f);
};

struct MomentsResult {
    vec4 quantised; ///< from b as moments
    vec4 moments; ///< from b as quantised
    vec2 before; ///< mass before t, and its integral of z - t
};

SHARED_END

#endif
