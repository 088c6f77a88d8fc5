// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/parts/volumes.h"

namespace gnomon::shadow::parts {

/// Shadow volumes as lines over the picture, for people to look at: silhouette edges as the light's centre sees them, and where their quads
/// begin and end along its rays, as far as the scene's diameter. They are the quads that count_volumes draws with the same settings; all
/// of them, whatever culling would leave out. Writes `out` (rgba8, size of the view): colour times coverage, and coverage; what lies
/// behind a surface is fainter. Frame::counters gets `volume_quads`.
void draw_volume_outlines(gpu::PassList&, const Frame&, VolumeCasters&, const VolumeSettings&, gpu::ImageId out);

} // namespace gnomon::shadow::parts
