// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_LIGHT_DEPTH_SHARED_H
#define GNOMON_LIGHT_DEPTH_SHARED_H
#include "shaders/light_map.shared.h"

SHARED_BEGIN(shaders)

struct LightDepthConstants {
    mat4 clip_from_world[LIGHT_MAP_MAX_LAYERS];
};

SHARED_END

#endif
