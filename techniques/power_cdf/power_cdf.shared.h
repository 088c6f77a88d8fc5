// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_POWER_CDF_SHARED_H
#define GNOMON_POWER_CDF_SHARED_H
#include "shaders/filter.shared.h"

TECHNIQUE_BEGIN(power_cdf)

struct Params {
    FilterParams filtering;
    float plane_bias DEFAULT(0.5f);
    float inset DEFAULT(0.3f);
    float bleed_reduction DEFAULT(0.0f);
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
