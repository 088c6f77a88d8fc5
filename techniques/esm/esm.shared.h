// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_ESM_SHARED_H
#define GNOMON_ESM_SHARED_H
#include "shaders/filter.shared.h"

TECHNIQUE_BEGIN(esm)

struct Params {
    FilterParams filtering DEFAULT({.bias = 0.0f});
    float exponent DEFAULT(80.0f);
    int space DEFAULT(0);
    int fallback DEFAULT(1);
    float threshold DEFAULT(0.1f);
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
