// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace gnomon::techniques::shadow_texture {

/// One bit for each primitive of the scene: whether it belongs to a caster. An instance casts where the sphere around its box has at most
/// `largest` times the radius of the sphere around the scene's; larger ones receive. Never empty.
std::vector<uint32_t> caster_bits(const scene::Scene&, float largest);

} // namespace gnomon::techniques::shadow_texture
