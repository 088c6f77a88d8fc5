// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/parts/volumes.h"

#include <span>

namespace gnomon::shadow::parts {

/// Makes what bounds shadow volumes, for whoever draws it: quads from silhouette edges and caps from triangles, of so many blocks of
/// casters at a time that memory does not grow with the scene. After `begin`, for each step: `make`, then draw what `draws` says
/// (VOLUME_QUADS ...).
class VolumeFaces {
public:
    /// `repeated`: a stencil will count, by one.
    VolumeFaces(gpu::PassList&, const Frame&, VolumeCasters&, const VolumeSettings&, bool repeated);

    void begin(); ///< finds on which side of each triangle the light lies
    uint32_t steps() const;
    void make(uint32_t step);
    /// A pass over all triangles, its first four bindings the scene's; more may be added.
    gpu::ComputePass each_triangle(const char* name, const char* shader, std::span<const gpu::SpecConstant>);
    gpu::BufferId slot_bands() const; ///< in their place, where there are none, what is as long

    shaders::VolumeTask task{}; ///< may be changed before `begin`
    gpu::BufferId quads, caps, sides, draws, work;

private:
    shaders::VolumeTask part(uint32_t first, uint32_t count, uint32_t most) const;
    gpu::ComputePass triangles(const char* name, const char* shader, std::span<const gpu::SpecConstant>, uint32_t first, uint32_t most);

    gpu::PassList& passes_;
    VolumeCasters& casters_;
    gpu::BufferId slot_bands_, instances_, positions_, indices_;
    uint32_t counted_, repeated_; ///< 0 or 1
};

} // namespace gnomon::shadow::parts
