// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/scene_gpu.h"
#include "techniques/alias_free/alias_free.shared.h"

#include <vector>

namespace gnomon::techniques::alias_free {

/// All opaque and masked triangles of a scene in blocks, for a compute pass with a group each.
std::vector<CasterBlock> caster_blocks(shadow::SceneGpu&);

} // namespace gnomon::techniques::alias_free
