// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/device.h"
#include "host/space.h"
#include "shadow/scene_gpu.h"

#include <array>
#include <memory>
#include <set>
#include <span>
#include <vector>

namespace gnomon::host {

/// A host's casters: its buffers, read by the device into the packed ones that every technique expects.
class Casters {
public:
    Casters(std::shared_ptr<Device>, const gnomon_scene_info&);
    Casters(const Casters&) = delete;
    Casters& operator=(const Casters&) = delete;

    void move(uint32_t first, std::span<const VkTransformMatrixKHR>);
    void deform(uint32_t mesh, const float (&lower)[3], const float (&upper)[3]);
    /// Passes that read what has changed of the host's buffers; call `read` once they are recorded.
    bool has_unread() const { return !unread_.empty(); }
    void add_reads(gpu::PassList&);
    void read() { unread_.clear(); }

    Device& device() const { return *device_; }
    shadow::SceneGpu& resources() { return *resources_; }
    const scene::Scene& scene() const { return scene_; }
    const dmat4& world_from_host() const { return world_from_host_; }
    bool has_vertices() const { return has_vertices_; } ///< every mesh came with positions

private:
    /// One of the host's meshes, once for each winding that its instances show.
    struct Source {
        gnomon_mesh mesh;
        bool turned;
    };
    int mesh_for(uint32_t mesh, bool mirrored); ///< of the scene; made when first asked for
    void add_instance(const gnomon_instance&, uint32_t number);
    gpu::TextureTable textures(const gnomon_scene_info&);
    /// What a stream becomes: `count` elements of `target` from `first` on.
    struct Packed {
        const char* shader;
        gpu::Buffer& target;
        uint32_t first, count;
        bool turned = false;
        uint32_t vertices = 0;
    };
    void add_stream(gpu::PassList&, const gnomon_stream&, const Packed&);

    std::shared_ptr<Device> device_;
    std::vector<gnomon_mesh> given_;
    std::vector<gnomon_material> materials_;
    dmat4 world_from_host_{1.0};
    scene::Scene scene_;
    std::vector<Source> sources_; ///< by the scene's mesh
    std::vector<bool> mirrored_; ///< by instance
    std::vector<std::array<int, 2>> meshes_; ///< by the host's mesh: the scene's, as given and turned; -1: none
    bool has_vertices_ = true;
    std::set<uint32_t> unread_; ///< meshes of the scene
    std::vector<gpu::Buffer> adopted_; ///< of the passes added last
    std::unique_ptr<shadow::SceneGpu> resources_;
};

} // namespace gnomon::host

struct gnomon_scene_t {
    std::shared_ptr<gnomon::host::Casters> casters;
};
