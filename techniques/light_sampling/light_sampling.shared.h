// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_LIGHT_SAMPLING_SHARED_H
#define GNOMON_LIGHT_SAMPLING_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

#define LIGHT_SAMPLING_MAPS 0
#define LIGHT_SAMPLING_RAYS 1

TECHNIQUE_BEGIN(light_sampling)

struct Params {
    int samples DEFAULT(64);
    int by DEFAULT(0);
    int pattern DEFAULT(0);
    int map_size DEFAULT(1024);
    int fit DEFAULT(1);
    int bilinear DEFAULT(1);
    float bias DEFAULT(0.5f); ///< texels
    int batch DEFAULT(8); ///< layers
};

/// One layer's part in the sum.
struct LayerSample {
    vec4 point; ///< of the light: as light_point gives it
    vec3 weight; ///< in each channel
    int face; ///< of a cube about the point: only receivers in it count; -1: all do
};

struct AddConstants {
    View view;
    Light light;
    LightMap map;
    LayerSample samples[LIGHT_MAP_MAX_LAYERS];
    Params params;
    uint count; ///< points of the light
    uint last; ///< 1: divides the sum by `count`
};

struct RayConstants {
    View view;
    Light light;
    uint count;
};

SHARED_END

#endif
