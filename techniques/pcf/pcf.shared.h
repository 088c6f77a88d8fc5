// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_PCF_SHARED_H
#define GNOMON_PCF_SHARED_H
#include "shaders/bias.shared.h"
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

#define PCF_BOX 0
#define PCF_GAUSSIAN 1
#define PCF_BICUBIC 2
#define PCF_POISSON 3
#define PCF_VOGEL 4
#define PCF_MAX_KERNEL 127
#define PCF_MAX_TAPS 128

TECHNIQUE_BEGIN(pcf)

struct Params {
    int map_size DEFAULT(1024);
    FitParams fitting;
    int kernel DEFAULT(9);
    int form DEFAULT(0);
    int bilinear DEFAULT(1);
    int taps DEFAULT(32);
    int rotation DEFAULT(0);
    int interleave DEFAULT(0);
    int adaptive DEFAULT(0);
    int window DEFAULT(0);
    BiasParams bias;
};

struct ResolveConstants {
    View view;
    Light light;
    LightMap map;
    Params params;
    int kernel; ///< the parameter, held to the map
    float beyond; ///< texels that a filter reads past its half width
    int largest; ///< no window is wider
    int groups; ///< pixels a side that share the taps
    int taps; ///< used in disk: a multiple of groups * groups
    vec2 disk[PCF_MAX_TAPS]; ///< unit disk, outermost first
};

struct GatherConstants {
    View view;
    int groups;
};

SHARED_END

#endif
