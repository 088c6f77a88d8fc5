// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_EVSM_SHARED_H
#define GNOMON_EVSM_SHARED_H
#include "shaders/filter.shared.h"

TECHNIQUE_BEGIN(evsm)

struct Params {
    FilterParams filtering;
    int components DEFAULT(1);
    int format DEFAULT(1);
    float exponent DEFAULT(40.0f);
    float negative_exponent DEFAULT(20.0f);
    float min_deviation DEFAULT(0.001f);
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
