// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_BLURRED_DEPTH_SHARED_H
#define GNOMON_BLURRED_DEPTH_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

TECHNIQUE_BEGIN(blurred_depth)

struct Params {
    int map_size DEFAULT(1024);
    int fit DEFAULT(1);
    int kernel DEFAULT(9);
    int compare DEFAULT(0);
    float softness DEFAULT(0.5f);
    float bias DEFAULT(0.01f);
};

struct BlurConstants {
    LightMapLayer layer;
    int index;
    int kernel;
    int vertical; ///< 0: reads the map's stored depth, 1: reads metres
};

struct ResolveConstants {
    View view;
    Light light;
    LightMap map;
    Params params;
};

SHARED_END

#endif
