// SPDX-License-Identifier: Apache-2.0
// Blocks of cascades that the GPU fits to what the depth buffer holds (parts/fit_sdsm.cpp).
#ifndef GNOMON_SDSM_SHARED_H
#define GNOMON_SDSM_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

SHARED_BEGIN(shaders)

/// Of samples: distance along the view's axis; x, y and depth in the light's axes. As unsigned integers that order as the floats do.
struct SampleBounds {
    uint least[4];
    uint least_negated[4]; ///< of the same numbers with the other sign: both kinds start from all bits set
};

/// What the passes hand on, and the result.
struct FittedMap {
    LightMap map;
    mat4 clip_from_world[LIGHT_MAP_MAX_LAYERS]; ///< as parts::clip_from_world
    SampleBounds all;
    SampleBounds cascades[LIGHT_MAP_MAX_LAYERS];
    vec2 ranges[LIGHT_MAP_MAX_LAYERS]; ///< of each cascade with its band, along the view's axis
};

struct SdsmReduce {
    View view;
    mat4 light_axes; ///< parts::light_axes
};

struct SdsmFit {
    LightMap fallback; ///< where no sample lies, and all but the layers and splits
    mat4 light_axes;
    FitParams fitting;
    vec2 casters; ///< least and greatest depth in the light's axes
    float rim_factor;
    float least_extent; ///< metres
    float near; ///< of a perspective view; 0: orthographic, cascades of one length
};

SHARED_END

#endif
