// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADOW_VOLUMES_SHARED_H
#define GNOMON_SHADOW_VOLUMES_SHARED_H
#include "shaders/frame.shared.h"

TECHNIQUE_BEGIN(shadow_volumes)

struct Params {
    int edges DEFAULT(2); ///< parts::VolumeEdges
    int count DEFAULT(1); ///< parts::VolumeCount
};

SHARED_END

#endif
