// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.h"
#include "vulkan.h"

#include <cstdint>
#include <vector>

namespace host {

/// A mesh in the scene's common vertex and index buffers.
struct Mesh {
    uint32_t first_vertex = 0, vertex_count = 0, first_index = 0, index_count = 0;
    float unpack = 1; ///< an instance's scale: 16-bit positions lie in [-1, 1]
    float lower[3], upper[3]; ///< bounds of the stored positions
    std::vector<float> positions; ///< as stored, for techniques that read them on the CPU
    std::vector<uint32_t> triangles;
};

/// As the shaders read it, for each instance.
struct InstanceData {
    VkTransformMatrixKHR host_from_object;
    float color[4]; ///< alpha 1: a checkered floor
};

/// A light and an eye, in the host's space.
struct Light {
    bool lamp = false; ///< else a sun
    Vec3 position, direction; ///< in which it shines
    float radius = 0; ///< of the lamp, in units; of the sun, half its apparent diameter in radians
    float inner_angle = 0, outer_angle = 0; ///< the lamp's cone, half angles
};
struct View {
    Mat4 view_from_host, clip_from_view;
};

/// The host's scene: how its vertices lie in memory, what moves, what may cast.
class Scene {
public:
    Scene(const Gpu&, const Convention&);

    Buffer vertices, indices; ///< 16-bit indices
    VkFormat position_format, normal_format, uv_format;
    uint32_t stride, normal_offset, uv_offset; ///< the position comes first
    std::vector<Mesh> meshes;
    std::vector<uint32_t> instances; ///< the mesh of each

    std::vector<InstanceData> pose(float seconds) const;
    Light light(float seconds, bool lamp) const;
    View view(float seconds, float aspect) const;

    /// The engine's own culling, here by spheres: whether this instance touches the volume inside all planes.
    bool touches(uint32_t instance, const std::vector<InstanceData>& posed, const float (*planes)[4], uint32_t count) const;

private:
    struct Placed {
        uint32_t mesh;
        Vec3 at, color;
        int motion; ///< 0: none
    };
    void store(const Gpu&, const std::vector<struct Shape>&);
    Convention convention_;
    std::vector<Placed> placed_;
};

} // namespace host
