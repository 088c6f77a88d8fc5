// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_CASTER_BLOCKS_SHARED_H
#define GNOMON_CASTER_BLOCKS_SHARED_H
#include "shaders/shared.h"

#define CASTER_BLOCK 64

SHARED_BEGIN(shaders)

/// Some triangles of one instance, for a group of a compute pass.
struct CasterBlock {
    uint slot; ///< of the instance
    uint first, count; ///< triangles of its mesh
    uint masked; ///< 0 or 1
};

/// A box around them in the world.
struct CasterBox {
    vec3 centre, half_size;
};

SHARED_END

#endif
