// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADOW_VOLUMES_SHARED_H
#define GNOMON_SHADOW_VOLUMES_SHARED_H
#include "shaders/frame.shared.h"

TECHNIQUE_BEGIN(shadow_volumes)

struct Params {
    int edges DEFAULT(2); ///< parts::VolumeEdges
    int count DEFAULT(1); ///< parts::VolumeCount
    int counter DEFAULT(0); ///< parts::VolumeCounter
    int order DEFAULT(0); ///< parts::VolumeOrder
    int log_alpha DEFAULT(0); ///< 0 or 1
    int scissor DEFAULT(1); ///< 0 or 1
    int culling DEFAULT(0); ///< none, casters, max, clamp, all
    int bands DEFAULT(16);
};

SHARED_END

#endif
