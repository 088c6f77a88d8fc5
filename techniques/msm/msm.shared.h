// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_MSM_SHARED_H
#define GNOMON_MSM_SHARED_H
#include "shaders/filter.shared.h"

TECHNIQUE_BEGIN(msm)

struct Params {
    FilterParams filtering DEFAULT({.bias = 0.12f});
    int format DEFAULT(1);
    float moment_bias DEFAULT(10.0f);
    float bleed_reduction DEFAULT(0.1f);
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
