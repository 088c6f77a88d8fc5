// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/technique.h"
#include "src/shadow/parts/volume_culling.shared.h"

// Which shadow volumes need not be drawn, and where in the picture: what saves a rasteriser most of its work and changes no pixel. The
// pixels of the G-buffer mark a mask in the light's space, as Décoret's litmaps do (2005), and the box of each instance asks it.
namespace gnomon::shadow::parts {

struct VolumeCulling {
    bool casters = true; ///< volumes that add to shadows only (Lloyd et al. 2004): a receiver that a triangle darkens for certain, as
                         ///< the light sees it, need not be reached by what lies behind that triangle
    bool max = true; ///< casters behind all receivers under their boxes, by one look into an N-buffer (Décoret 2005); without, texel by
                     ///< texel
    bool clamp = true; ///< the picture in bands across the light's direction, each with casters of its own (Lloyd et al. 2004: discrete
                       ///< clamping)
    int bands = 16; ///< at most VOLUME_MAX_BANDS
    gpu::ImageId decided{}; ///< as VolumeSettings::decided (volumes.h): receivers count for nothing but where it is negative
};

struct CulledVolumes {
    gpu::BufferId slots; ///< a uint for each slot of SceneGpu::instances(): volume_culling.shared.h
    shaders::VolumeBands bands;
};

/// Whole rows or columns of pixels, whichever lie more across the light's direction in the picture.
shaders::VolumeBands volume_bands(const scene::View&, const scene::Light&, int count);

/// For a light taken as its centre, directional, spot or point. Receivers that face away from it, or that it does not reach, are taken to
/// be dark whatever casts; a volume that does not hold a receiver is taken to leave it alone. So volumes are to be counted in a way that
/// does not depend on the eye's place in others: by what lies beyond the receiver (z-fail), not before it. Instances are dropped or kept
/// whole. Leaves `casters_culled` and `bands_culled`, of those that are left, in Frame::counters.
CulledVolumes cull_volumes(gpu::PassList&, const Frame&, const VolumeCulling&);

} // namespace gnomon::shadow::parts
