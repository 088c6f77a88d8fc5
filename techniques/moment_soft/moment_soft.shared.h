// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_MOMENT_SOFT_SHARED_H
#define GNOMON_MOMENT_SOFT_SHARED_H
#include "shaders/prefiltered_soft.shared.h"

TECHNIQUE_BEGIN(moment_soft)

struct Params {
    PrefilteredSoftParams prefiltered;
    int grid DEFAULT(3);
    int centred DEFAULT(1);
    float tilt DEFAULT(0.5f);
    float depth_bias DEFAULT(0.0005f);
    float moment_bias DEFAULT(0.5f);
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
