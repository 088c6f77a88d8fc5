// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_LIGHT_DEPTH_SHARED_H
#define GNOMON_LIGHT_DEPTH_SHARED_H
#include "shaders/light_map.shared.h"

SHARED_BEGIN(shaders)

struct LightDepthConstants {
    mat4 clip_from_world[LIGHT_MAP_MAX_LAYERS];
    vec4 depth_planes[LIGHT_MAP_MAX_LAYERS]; ///< the rest is for warped layers
    vec4 ranges[LIGHT_MAP_MAX_LAYERS]; ///< near, far, perspective, slope bias
};

SHARED_END

#endif
