// SPDX-License-Identifier: Apache-2.0
// Cases of shaders/light_samples.glsl.
#ifndef GNOMON_TESTS_LIGHT_SAMPLES_SHARED_H
#define GNOMON_TESTS_LIGHT_SAMPLES_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

/// Three rectangles (x0, y0, x1, y1), hidden one after another.
struct HiddenCase {
    vec4 rectangles[3];
};

struct HiddenResult {
    uint mask[8];
    float area;
    float visible;
    vec3 colors;
    uint all;
};

SHARED_END

#endif
