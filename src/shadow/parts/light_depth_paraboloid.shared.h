// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_LIGHT_DEPTH_PARABOLOID_SHARED_H
#define GNOMON_LIGHT_DEPTH_PARABOLOID_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

struct ParaboloidConstants {
    mat4 map_from_world[2]; ///< LightMapLayer's
    float near;
    float far;
    float slope_bias;
    float size; ///< texels a side
    int cull; ///< 0 none, 1 back faces, 2 front faces
};

SHARED_END

#endif
