// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SLICE_SHARED_H
#define GNOMON_SLICE_SHARED_H
#include "shaders/frame.shared.h"

SHARED_BEGIN(shaders)

struct SliceConstants {
    View view;
    Light light;
    float depth; ///< of the plane, which the view faces
};

SHARED_END

#endif
