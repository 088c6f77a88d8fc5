// SPDX-License-Identifier: Apache-2.0
#include "techniques/virtual_shadow_map/casters.h"

#include "base/hash.h"

#include <algorithm>

namespace gnomon::techniques::virtual_shadow_map {

namespace {

using namespace shadow;

/// Neighbours in the index buffer are mostly neighbours in space. Smaller clusters draw fewer triangles beside a page, and take more
/// draw commands.
constexpr size_t cluster_triangles = 64;

std::vector<Bounds> cluster_bounds(const scene::Mesh& mesh)
{
    std::vector<Bounds> out;
    for (size_t first = 0; first < mesh.indices.size(); first += 3 * cluster_triangles) {
        Bounds b;
        for (size_t i = first; i < std::min(first + 3 * cluster_triangles, mesh.indices.size()); ++i)
            b.add(mesh.positions[mesh.indices[i]]);
        out.push_back(b);
    }
    return out;
}

template <class T> gpu::Buffer upload(gpu::Device& device, const std::vector<T>& values, const char* name)
{
    // never empty: an empty storage buffer cannot be bound
    gpu::Buffer buffer = device.buffer({std::max<uint64_t>(values.size(), 1) * sizeof(T), 0, gpu::Memory::device, name});
    if (!values.empty()) device.upload(buffer, std::as_bytes(std::span(values)));
    return buffer;
}

} // namespace

std::vector<bool> Casters::update_shapes(const scene::Scene& scene)
{
    std::vector<bool> changed(scene.meshes.size(), false);
    shapes_.resize(scene.meshes.size());
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const std::string content = base::Hasher().array(scene.meshes[m].positions).array(scene.meshes[m].indices).hex();
        changed[m] = content != shapes_[m].content;
        if (changed[m]) shapes_[m] = {content, cluster_bounds(scene.meshes[m])};
    }
    return changed;
}

std::vector<Bounds> Casters::find_moved(const std::vector<Placed>& now, const std::vector<bool>& changed) const
{
    std::vector<Bounds> out;
    for (size_t i = 0; i < now.size(); ++i) {
        if (now[i].world_from_object == placed_[i].world_from_object && !changed[now[i].drawable.mesh]) continue;
        out.push_back(placed_[i].bounds);
        out.push_back(now[i].bounds);
    }
    return out;
}

void Casters::upload_clusters(gpu::Device& device)
{
    std::vector<Cluster> clusters;
    const auto add = [&](DrawSet set) {
        const size_t before = clusters.size();
        for (const Placed& p : placed_) {
            if (p.drawable.set != set) continue;
            const SceneGpu::Drawable& d = p.drawable;
            for (size_t i = 0; i < shapes_[d.mesh].clusters.size(); ++i) {
                const Bounds b = transformed(shapes_[d.mesh].clusters[i], p.world_from_object);
                const uint32_t first = uint32_t(3 * cluster_triangles * i);
                clusters.push_back({b.centre(), d.first_index + first, 0.5f * (b.max - b.min),
                    std::min(uint32_t(3 * cluster_triangles), d.index_count - first), int32_t(d.first_vertex), d.slot});
            }
        }
        return uint32_t(clusters.size() - before);
    };
    opaque_ = add(draw_opaque);
    masked_ = add(draw_masked);
    clusters_ = upload(device, clusters, "clusters");
}

bool Casters::update(gpu::Device& device, SceneGpu& resources)
{
    moved_count_ = 0;
    if (content_ && content_ == resources.content()) return true;
    const scene::Scene& scene = resources.scene();
    std::vector<Placed> now;
    for (const SceneGpu::Drawable& d : resources.drawables()) {
        const mat4& m = scene.instances[d.instance].world_from_object;
        now.push_back({d, m, transformed(scene.meshes[d.mesh].bounds, m)});
    }
    const std::vector<bool> changed = update_shapes(scene);
    const bool same = now.size() == placed_.size()
        && std::equal(now.begin(), now.end(), placed_.begin(), [](const Placed& a, const Placed& b) { return a.drawable == b.drawable; });
    const std::vector<Bounds> moved = same ? find_moved(now, changed) : std::vector<Bounds>();
    placed_ = now;
    content_ = resources.content();
    std::vector<Box> boxes;
    for (const Bounds& b : moved) boxes.push_back({b.centre(), 0.5f * (b.max - b.min)});
    moved_ = upload(device, boxes, "moved");
    moved_count_ = uint32_t(boxes.size());
    upload_clusters(device);
    return same;
}

} // namespace gnomon::techniques::virtual_shadow_map
