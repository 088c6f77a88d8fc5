// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_BLURRED_DEPTH_SHARED_H
#define GNOMON_BLURRED_DEPTH_SHARED_H
#include "shaders/filter.shared.h"

TECHNIQUE_BEGIN(blurred_depth)

struct Params {
    FilterParams filtering DEFAULT({.bias = 0.11f});
    int compare DEFAULT(0);
    float softness DEFAULT(0.5f);
};

struct ResolveConstants {
    FilterResolve filtering;
    Params params;
};

SHARED_END

#endif
