// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_RAY_TRACED_SHARED_H
#define GNOMON_RAY_TRACED_SHARED_H
#include "shaders/frame.shared.h"

TECHNIQUE_BEGIN(ray_traced)

struct Params {
    int samples DEFAULT(16);
};

struct TraceConstants {
    View view;
    Light light;
    Params params;
};

SHARED_END

#endif
