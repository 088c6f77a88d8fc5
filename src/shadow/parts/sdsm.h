// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/parts/light_map.h"
#include "src/shadow/parts/sdsm.shared.h"

// Sample distribution shadow maps (Lauritzen, Salvi, Lefohn 2011): cascades fitted to the receivers that the depth buffer holds. Found,
// laid out and used on the GPU: nothing is read back, so no frame of latency in which a receiver could lie outside of every layer.
namespace gnomon::shadow::parts {

/// Adds the passes that fit. On entry `map` is what fit_light_map says; on return its layers hold whatever may be fitted, for culling and
/// for pictures without receivers. The buffer holds a shaders::FittedMap.
gpu::BufferId fit_to_samples(gpu::PassList&, const Frame&, const LightMapSettings&, shaders::LightMap& map);

} // namespace gnomon::shadow::parts
