// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_GAUSSIAN_SHARED_H
#define GNOMON_GAUSSIAN_SHARED_H
#include "shaders/shared.h"

#define GAUSSIAN_MAX_WIDTH 127

SHARED_BEGIN(shaders)

struct GaussianConstants {
    int width; ///< taps
    int axis; ///< 0: along x, 1: along y
    int layer;
    float weights[GAUSSIAN_MAX_WIDTH]; ///< sum to 1
};

SHARED_END

#endif
