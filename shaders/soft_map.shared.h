// SPDX-License-Identifier: Apache-2.0
// Blocks of the soft shadow methods that look at one light map, drawn from the centre of a light with an area.
#ifndef GNOMON_SHADERS_SOFT_MAP_SHARED_H
#define GNOMON_SHADERS_SOFT_MAP_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

SHARED_BEGIN(shaders)

/// Parameters that they share (parts::describe_soft).
struct SoftParams {
    int map_size DEFAULT(1024);
    FitParams fitting;
    float bias DEFAULT(1.0f); ///< texels
};

/// For shaders/soft_map.glsl.
struct SoftResolve {
    View view;
    Light light;
    LightMap map;
    SoftParams params;
};

SHARED_END

#endif
