// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADOW_MAP_SHARED_H
#define GNOMON_SHADOW_MAP_SHARED_H
#include "shaders/bias.shared.h"
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

TECHNIQUE_BEGIN(shadow_map)

struct Params {
    int map_size DEFAULT(2048);
    FitParams fitting;
    int depth DEFAULT(0);
    int pcf DEFAULT(3);
    int bilinear DEFAULT(1);
    BiasParams bias;
    int culling DEFAULT(1);
};

struct ResolveConstants {
    View view;
    Light light;
    LightMap map;
    Params params;
    float reach; ///< texels between a receiver and the farthest centre of one that is read
};

SHARED_END

#endif
