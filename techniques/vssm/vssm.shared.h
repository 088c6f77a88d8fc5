// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VSSM_SHARED_H
#define GNOMON_VSSM_SHARED_H
#include "shaders/filter.shared.h"
#include "shaders/soft_map.shared.h"

#define SUBDIVIDE_NONE 0
#define SUBDIVIDE_UNIFORM 1
#define SUBDIVIDE_ADAPTIVE 2
#define SUBDIVIDE_MIXED 3

#define SUMS_INTEGER 0
#define SUMS_FLOAT 1

TECHNIQUE_BEGIN(vssm)

struct Params {
    SoftParams soft;
    int sums DEFAULT(SUMS_INTEGER);
    float widest DEFAULT(0.25f);
    int subdivision DEFAULT(SUBDIVIDE_MIXED);
    int grid DEFAULT(5);
    int height DEFAULT(3);
    int per_cell DEFAULT(1);
    int equal_area DEFAULT(1);
    float flat_deviation DEFAULT(0.001f);
    float min_deviation DEFAULT(0.0005f);
    float contact DEFAULT(0.01f);
    float bleed_reduction DEFAULT(0.0f);
};

struct ValuesConstants {
    FilterValues map;
    float dither; ///< of stored values, full width: a step of the integers, or 0
};

struct ResolveConstants {
    SoftResolve soft;
    Params params;
    float sum_step; ///< value of one count of integer sums
    float widest; ///< texels a side of the widest window
    float scene_radius; ///< metres
    float kernel_scale; ///< of the kernel's half width: to the area of a round light, or 1
};

SHARED_END

#endif
