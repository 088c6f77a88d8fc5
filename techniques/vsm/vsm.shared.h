// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VSM_SHARED_H
#define GNOMON_VSM_SHARED_H
#include "shaders/filter.shared.h"

TECHNIQUE_BEGIN(vsm)

struct Params {
    FilterParams filtering;
    float min_deviation DEFAULT(0.001f);
    int slope_moment DEFAULT(0);
    float bleed_reduction DEFAULT(0.2f);
};

struct ValuesConstants {
    FilterValues map;
    Params params;
};

struct ResolveConstants {
    FilterResolve filtering;
    Params params;
};

SHARED_END

#endif
