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

/// How a face and a receiver are put in order along the eye's ray.
enum class VolumeOrder : int {
    planes, ///< by the side of the face's plane on which the receiver lies: exact
    depth ///< by the depth test, which leaves out what it fails without shading it; interpolated depth puts single pixels wrong
};

/// What counts.
enum class VolumeCounter : int {
    automatic, ///< blend: as fast, and without the stencil's limit
    stencil, ///< 8 bits, of which 256 overlapping volumes would be read as none: taken for scenes of fewer triangles alone
    blend ///< additions to a float image, exact to 2^24
};

struct VolumeSettings {
    VolumeEdges edges = VolumeEdges::any;
    VolumeCount count = VolumeCount::zfail;
    VolumeCounter counter = VolumeCounter::automatic;
    VolumeOrder order = VolumeOrder::planes; ///< by depth it is the blending that counts
    bool transmittance = false; ///< adds up logarithms of what casters let through, in each colour (Kim et al. 2008)
    bool scissor = true; ///< a spot's volumes only where its cone is seen
    gpu::BufferId slot_bands{}; ///< parts/volume_culling.h: where volumes need be drawn; counts of zfail only
    const shaders::VolumeBands* bands = nullptr;
    gpu::ImageId decided{}; ///< r32f, of visibility that is known: nothing is counted but where it is negative
};

/// The casters of a scene as volumes need them, made once and kept between frames.
class VolumeCasters {
public:
    /// Makes them anew where the scene is another one. `blended`: semitransparent triangles cast too.
    void update(SceneGpu&, bool blended);
    uint64_t bytes() const;

    gpu::Buffer edges, lists, triangle_blocks, edge_blocks;
    gpu::Buffer weights; ///< of slots: what a crossing adds in red, green, blue, and opaque ones
    uint32_t triangle_block_count = 0, edge_block_count = 0, primitives = 0;
    uint32_t triangles = 0; ///< that cast

private:
    std::shared_ptr<const void> shapes_;
    bool blended_ = false;
};

/// What was counted for each pixel.
struct VolumeCounts {
    gpu::ImageId receivers, counts;
    gpu::BufferId eye; ///< four numbers to add
    bool stencil = false; ///< in the stencil of `counts`
};

VolumeCounts count_volumes(gpu::PassList&, const Frame&, VolumeCasters&, const VolumeSettings&);
/// Writes the visibility, or the transmittance.
void resolve_volumes(gpu::PassList&, const Frame&, const VolumeSettings&, const VolumeCounts&);

/// Pixels that the cone of a spot may reach within the scene; all of the picture's for other lights.
struct PixelRectangle {
    int x, y;
    uint32_t width, height;
};
PixelRectangle lit_rectangle(const scene::View&, const scene::Light&, const Bounds& scene);

} // namespace gnomon::shadow::parts
