// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_CSM_SHARED_H
#define GNOMON_CSM_SHARED_H
#include "shaders/filter.shared.h"

TECHNIQUE_BEGIN(csm)

struct Params {
    FilterParams filtering;
    int terms DEFAULT(8);
    int format DEFAULT(0);
    float attenuation DEFAULT(0.0f);
    float offset DEFAULT(0.0f);
    float scale DEFAULT(2.0f);
    float bleed_reduction DEFAULT(0.12f);
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
