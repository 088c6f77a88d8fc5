// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"

#include <cstdint>

namespace gnomon::shadow::parts {

/// A full-screen pass over `layers` layers from `target`'s on, in one. The program's vertex shader is shaders/fullscreen_layers.vert,
/// whose output `layer` counts from 0.
void fullscreen_layers(gpu::PassList&, gpu::FullscreenPass, uint32_t layers);

} // namespace gnomon::shadow::parts
