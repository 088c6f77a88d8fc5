// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VSSM_SHARED_H
#define GNOMON_VSSM_SHARED_H
#include "shaders/prefiltered_soft.shared.h"

#define SUBDIVIDE_NONE 0
#define SUBDIVIDE_UNIFORM 1
#define SUBDIVIDE_ADAPTIVE 2
#define SUBDIVIDE_MIXED 3

TECHNIQUE_BEGIN(vssm)

struct Params {
    PrefilteredSoftParams prefiltered;
    int subdivision DEFAULT(SUBDIVIDE_UNIFORM);
    int grid DEFAULT(5);
    int height DEFAULT(3);
    int per_cell DEFAULT(1);
    int centred DEFAULT(1);
    float flat_deviation DEFAULT(0.001f);
    float min_deviation DEFAULT(0.0005f);
    float bleed_reduction DEFAULT(0.0f);
};

struct ValuesConstants {
    FilterValues map;
    float dither; ///< of stored values, full width: a step of the integers, or 0
};

struct ResolveConstants {
    SoftResolve soft;
    PrefilteredSoft prefiltered;
    Params params;
};

SHARED_END

#endif
