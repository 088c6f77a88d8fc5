// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/scene_gpu.h"
#include "src/shadow/parts/caster_blocks.shared.h"

#include <span>
#include <vector>

namespace gnomon::shadow::parts {

/// All opaque triangles of a scene and then all masked ones, in blocks of CASTER_BLOCK, for a compute pass with a group each.
std::vector<shaders::CasterBlock> caster_blocks(const SceneGpu&);

/// Around what each of some blocks holds, with room for the rounding of a vertex's place. Found once for each mesh in its own space.
std::vector<shaders::CasterBox> caster_boxes(const SceneGpu&, std::span<const shaders::CasterBlock>);

} // namespace gnomon::shadow::parts
