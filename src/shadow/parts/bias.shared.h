// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_BIAS_PASSES_SHARED_H
#define GNOMON_BIAS_PASSES_SHARED_H
#include "shaders/bias.shared.h"

SHARED_BEGIN(shaders)

struct BiasLayersConstants {
    LightMap map;
    float constant; ///< metres
    float texels;
    uint capped; ///< 0 or 1: no farther than b
};

SHARED_END

#endif
