// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_CASTERS_SHARED_H
#define GNOMON_CASTERS_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

/// An instance for shaders that choose what is drawn (SceneGpu::casters).
struct Caster {
    vec3 least, most; ///< world bounds
    uint index_count, first_index;
    int vertex_offset;
    uint blended; ///< 0 or 1: casts no shadow in a map
};

/// VkDrawIndexedIndirectCommand.
struct DrawCommand {
    uint index_count, instance_count, first_index;
    int vertex_offset;
    uint first_instance;
};

SHARED_END

#endif
