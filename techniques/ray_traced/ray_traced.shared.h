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
    float scene_extent; ///< largest coordinate of the scene's bounds, metres: scales rounding errors
};

SHARED_END

#endif
