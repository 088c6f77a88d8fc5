// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/technique.h"
#include "src/shadow/parts/volumes.shared.h"

#include <memory>
#include <string>

// Shadow volumes (Crow 1977): what lies behind a caster is bounded by quads from its silhouette away from the light, and a point is dark
// where a ray to it enters volumes more often than it leaves them.
namespace gnomon::shadow::parts {

/// From which edges quads are drawn.
enum class VolumeEdges : int {
    closed, ///< between a triangle that the light sees and one that it does not; right for closed meshes
    bergeron, ///< and half as many at open borders (Bergeron 1986); right where no edge has more than two triangles
    any ///< as many as do not cancel (Aldridge and Woods 2004); always right
};

/// Where counting begins.
enum class VolumeCount : int {
    zpass, ///< at the eye, which is taken to be lit
    zfail, ///< at infinity, which is
    zp_plus, ///< at the near plane, whose own count is drawn from the light (Hornus et al. 2005)
    pp_zp ///< at the eye, whose own count is found by a test of each triangle
};

struct VolumeSettings {
    VolumeEdges edges = VolumeEdges::any;
    VolumeCount count = VolumeCount::zpass;
};

/// The casters of a scene as volumes need them, made once and kept between frames.
class VolumeCasters {
public:
    /// Makes them anew where the scene is another one.
    void update(SceneGpu&);
    uint64_t bytes() const;

    gpu::Buffer edges, lists, triangle_blocks, edge_blocks;
    uint32_t triangle_block_count = 0, edge_block_count = 0, primitives = 0;

private:
    std::shared_ptr<const void> content_;
};

/// What was counted for each pixel.
struct VolumeCounts {
    gpu::ImageId receivers, counts;
};

VolumeCounts count_volumes(gpu::PassList&, const Frame&, VolumeCasters&, const VolumeSettings&);
/// Writes the visibility.
void resolve_volumes(gpu::PassList&, const Frame&, const VolumeCounts&);

} // namespace gnomon::shadow::parts
