// SPDX-License-Identifier: Apache-2.0
// Blocks of the passes that choose casters (parts/cull.h).
#ifndef GNOMON_CULL_SHARED_H
#define GNOMON_CULL_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

/// Texels a side of a layer's mask of receivers. Each holds the greatest depth of the receivers whose filters may look there.
#define CULL_MASK_SIZE 128

SHARED_BEGIN(shaders)

struct CullConstants {
    View view;
    Light light;
    LightMap map;
    float reach; ///< texels of the map between a receiver and the farthest one that it reads
    uint casters;
};

SHARED_END

#endif
