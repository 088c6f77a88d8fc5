// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_HOST_GATHER_SHARED_H
#define GNOMON_HOST_GATHER_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

#define GATHER_FLOAT32 0
#define GATHER_FLOAT16 1
#define GATHER_SNORM16 2
#define GATHER_UNORM16 3

/// A host's stream on its way into the scene's own buffers.
struct GatherConstants {
    uint count; ///< vertices, or indices
    uint first; ///< place of the first in the target
    uint stride, offset; ///< bytes
    uint format; ///< GATHER_*; indices: 1 of 16 bits
    uint given; ///< 0: there is no source
    uint turned; ///< indices: 1 swaps the last two of each triangle
    uint vertices; ///< indices: how many vertices there are
};

SHARED_END

#endif
