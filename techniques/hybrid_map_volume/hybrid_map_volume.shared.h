// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_HYBRID_MAP_VOLUME_SHARED_H
#define GNOMON_HYBRID_MAP_VOLUME_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

TECHNIQUE_BEGIN(hybrid_map_volume)

struct Params {
    int map_size DEFAULT(2048);
    FitParams fitting;
    int reach DEFAULT(1);
    float bias_scale DEFAULT(1.0f);
    int exact DEFAULT(0); ///< rays, volumes
    int culling DEFAULT(1); ///< parts::Culling
};

struct HybridConstants {
    View view;
    Light light;
    LightMap map;
    float bias_scale;
};

/// VkDispatchIndirectCommand.
struct Dispatch {
    uint x, y, z;
};

/// Pixels that a group of the pass over marked pixels takes, and the most groups that every device runs along an axis.
#define MARKED_GROUP 64
#define MARKED_GROUPS 65535

SHARED_END

#endif
