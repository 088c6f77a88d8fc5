// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADERS_BIAS_SHARED_H
#define GNOMON_SHADERS_BIAS_SHARED_H
#include "shaders/light_map.shared.h"

#define BIAS_CONSTANT 0
#define BIAS_SLOPE 1
#define BIAS_NORMAL_OFFSET 2
#define BIAS_RECEIVER_PLANE 3
#define BIAS_CONE 4
#define BIAS_TEXEL_WORLD 5
#define BIAS_SECOND_DEPTH 6
#define BIAS_MIDPOINT 7
#define BIAS_DUAL_LAYERS 8
#define BIAS_IDS 9

SHARED_BEGIN(shaders)

/// What keeps a surface from shadowing itself (parts::describe_bias, docs/bias.md).
struct BiasParams {
    int kind DEFAULT(BIAS_CONE);
    float constant DEFAULT(0.0f); ///< metres
    float scale DEFAULT(1.0f); ///< times what the kind takes by itself
};

SHARED_END

#endif
