// SPDX-License-Identifier: Apache-2.0
// Cases of the lookups over windows of texels.
#ifndef GNOMON_TESTS_WINDOWS_SHARED_H
#define GNOMON_TESTS_WINDOWS_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

struct WindowCase {
    int layer;
    vec2 lo;
    vec2 hi;
};

struct IntegerSums {
    uvec4 sum; ///< of the whole texels from floor(lo) to floor(hi)
    vec4 mean;
};

struct FootprintCase {
    int layer;
    int most; ///< probes
    vec2 uv;
    vec2 uv_dx;
    vec2 uv_dy;
};

struct FootprintResult {
    vec2 major;
    float minor;
    vec4 mean;
    vec4 trilinear; ///< one fetch as wide as the long axis
};

SHARED_END

#endif
