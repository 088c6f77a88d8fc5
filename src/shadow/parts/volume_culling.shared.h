// SPDX-License-Identifier: Apache-2.0
// What parts/volume_culling.h says about each volume, for those who draw them.
#ifndef GNOMON_VOLUME_CULLING_SHARED_H
#define GNOMON_VOLUME_CULLING_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

/// A slot of SceneGpu::instances() has one uint. Bit b: the volume of this instance may darken a receiver that is seen in band b; 0: it
/// darkens nothing, and need not be drawn.
#define VOLUME_MAX_BANDS 32

SHARED_BEGIN(shaders)

/// The picture cut into bands by planes through the eye, in world space: a point in front of the eye lies in band b where
/// dot(planes[b], (p, 1)) >= 0 and dot(planes[b + 1], (p, 1)) < 0; the first band has no beginning and the last no end, and their planes
/// are not to be read. Planes run between two rows or columns of pixels, half a pixel from all centres: volumes clipped at them cover
/// the same pixels whatever the rounding, so that a pixel has all of a volume or nothing of it, and no caps are needed there.
struct VolumeBands {
    uint count;
    vec4 planes[VOLUME_MAX_BANDS + 1];
};

SHARED_END

#endif
