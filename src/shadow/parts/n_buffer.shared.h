// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_N_BUFFER_PASS_SHARED_H
#define GNOMON_N_BUFFER_PASS_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

/// A window is joined from four of the level before, at these offsets along each axis.
struct NBufferConstants {
    int near;
    int far;
};

SHARED_END

#endif
