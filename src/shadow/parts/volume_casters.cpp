// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "shadow/parts/volume_edges.h"
#include "shadow/parts/volumes.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

template <class T> gpu::Buffer make_buffer(SceneGpu& scene, const std::vector<T>& values, const char* name)
{
    const uint64_t bytes = std::max<uint64_t>(values.size(), 1) * sizeof(T), limit = scene.device().limits().maxStorageBufferRange;
    if (bytes > limit)
        base::fail("the {} of the scene '{}' take {} bytes, and a buffer of this device {}; choose a scene of fewer triangles", name,
            scene.scene().name, bytes, limit);
    gpu::Buffer buffer = scene.device().buffer({bytes, 0, gpu::Memory::device, name});
    if (!values.empty()) scene.device().upload(buffer, std::as_bytes(std::span(values)));
    return buffer;
}

void add_blocks(std::vector<shaders::VolumeBlock>& blocks, uint32_t slot, uint32_t first, uint32_t count, uint32_t flags)
{
    for (uint32_t i = 0; i < count; i += VOLUME_GROUP)
        blocks.push_back({slot, first + i, std::min(count - i, uint32_t(VOLUME_GROUP)), flags});
}

struct EdgeRange {
    uint32_t first, count;
};

/// The edges of all meshes behind one another.
struct AllEdges {
    MeshEdges all;
    std::vector<EdgeRange> ranges; ///< by mesh

    explicit AllEdges(const scene::Scene& scene)
    {
        for (const scene::Mesh& mesh : scene.meshes) {
            MeshEdges own = mesh_edges(mesh.positions, mesh.indices);
            for (shaders::VolumeEdge& e : own.edges)
                if (e.second != VOLUME_ALONE && (e.second & VOLUME_LIST) != 0) e.first += uint32_t(all.list.size());
            ranges.push_back({uint32_t(all.edges.size()), uint32_t(own.edges.size())});
            all.edges.insert(all.edges.end(), own.edges.begin(), own.edges.end());
            all.list.insert(all.list.end(), own.list.begin(), own.list.end());
        }
    }
};

/// Of a material that is the same all over: textures and colours of vertices do not count.
glm::ivec4 weight_of(const scene::Material& material)
{
    const vec3 through = scene::transmittance(material, material.base_color);
    if (std::max({through.x, through.y, through.z}) <= 0.0f) return {0, 0, 0, 1};
    glm::ivec4 weight(0);
    for (int k = 0; k < 3; ++k)
        weight[k] = int(std::lround(float(VOLUME_LOG_PARTS) * std::max(std::log2(through[k]), float(VOLUME_LEAST_LOG))));
    return weight;
}

} // namespace

void VolumeCasters::update(SceneGpu& scene, bool blended)
{
    if (shapes_ == scene.shapes() && blended_ == blended) return;
    const AllEdges edges_of(scene.scene());
    std::vector<shaders::VolumeBlock> of_triangles, of_edges;
    std::vector<glm::ivec4> of_slots(std::max(scene.slot_count(), 1u));
    primitives = 1, triangles = 0;
    for (const SceneGpu::Drawable& d : scene.drawables()) {
        primitives += d.index_count / 3;
        if (d.set == draw_blended && !blended) continue;
        triangles += d.index_count / 3;
        const scene::Material& material = scene.scene().materials[size_t(scene.scene().meshes[d.mesh].material)];
        const uint32_t flags = d.set != draw_opaque ? VOLUME_UNSEEN : material.double_sided ? 0 : VOLUME_ONE_SIDED;
        of_slots[d.slot] = weight_of(material);
        add_blocks(of_triangles, d.slot, 0, d.index_count / 3, flags);
        add_blocks(of_edges, d.slot, edges_of.ranges[d.mesh].first, edges_of.ranges[d.mesh].count, flags);
    }
    const uint64_t limit = scene.device().limits().maxStorageBufferRange;
    if (uint64_t(primitives) * 4 > limit)
        base::fail("the scene '{}' places {} triangles, and a buffer of {} bytes has room for the sides of {}; place fewer",
            scene.scene().name, primitives, limit, limit / 4);
    edges = make_buffer(scene, edges_of.all.edges, "volume edges");
    lists = make_buffer(scene, edges_of.all.list, "triangles at edges");
    triangle_blocks = make_buffer(scene, of_triangles, "blocks of triangles");
    edge_blocks = make_buffer(scene, of_edges, "blocks of edges");
    weights = make_buffer(scene, of_slots, "weights of casters");
    triangle_block_count = uint32_t(of_triangles.size()), edge_block_count = uint32_t(of_edges.size());
    shapes_ = scene.shapes(), blended_ = blended;
}

uint64_t VolumeCasters::bytes() const
{
    uint64_t sum = 0;
    for (const gpu::Buffer* b : {&edges, &lists, &triangle_blocks, &edge_blocks, &weights}) sum += *b ? b->desc().bytes : 0;
    return sum;
}

} // namespace gnomon::shadow::parts
