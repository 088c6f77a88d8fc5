// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

#include "shadow/technique.h"

#include <memory>
#include <vector>

namespace gnomon::techniques::virtual_shadow_map {

/// The scene's casters, cut into clusters that are culled one by one, and what moved of them since the frame before.
class Casters {
public:
    /// False where another scene has come: nothing drawn before is of use.
    bool update(gpu::Device&, shadow::SceneGpu&);

    gpu::Buffer& clusters() { return clusters_; } ///< opaque ones first
    uint32_t opaque() const { return opaque_; }
    uint32_t masked() const { return masked_; }
    gpu::Buffer& moved() { return moved_; } ///< boxes before and after
    uint32_t moved_count() const { return moved_count_; }
    uint64_t bytes() const { return (clusters_ ? clusters_.desc().bytes : 0) + (moved_ ? moved_.desc().bytes : 0); }

private:
    struct Placed {
        shadow::SceneGpu::Drawable drawable;
        mat4 world_from_object;
        Bounds bounds; ///< in the world
    };
    struct Shape {
        std::string content; ///< hash of its vertices and indices
        std::vector<Bounds> clusters; ///< in its own space
    };

    std::vector<Bounds> find_moved(const std::vector<Placed>&, const std::vector<bool>& changed) const;
    std::vector<bool> update_shapes(const scene::Scene&);
    void upload_clusters(gpu::Device&);

    std::shared_ptr<const void> content_;
    std::vector<Placed> placed_;
    std::vector<Shape> shapes_; ///< by mesh
    gpu::Buffer clusters_, moved_;
    uint32_t opaque_ = 0, masked_ = 0, moved_count_ = 0;
};

} // namespace gnomon::techniques::virtual_shadow_map
