// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_BACK_PROJECTION_SHARED_H
#define GNOMON_BACK_PROJECTION_SHARED_H
#include "shaders/soft_map.shared.h"

TECHNIQUE_BEGIN(back_projection)

struct Params {
    SoftParams soft;
    int layers DEFAULT(1);
    int occluders DEFAULT(3);
    int accumulate DEFAULT(2);
    int gaps DEFAULT(1);
    int search DEFAULT(2);
    int budget DEFAULT(64);
    int levels DEFAULT(0);
    int coarse DEFAULT(0);
    float x DEFAULT(0.75f);
};

struct ResolveConstants {
    SoftResolve soft;
    Params params;
};

SHARED_END

#endif
