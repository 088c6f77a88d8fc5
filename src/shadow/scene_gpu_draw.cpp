// SPDX-License-Identifier: Apache-2.0
#include "shadow/scene_gpu_impl.h"
#include "src/shadow/casters.shared.h"

#include <algorithm>

namespace gnomon::shadow {

Planes frustum_planes(const mat4& m)
{
    const auto row = [&](int r) { return vec4(m[0][r], m[1][r], m[2][r], m[3][r]); };
    // Gribb and Hartmann 2001: -w <= x <= w, -w <= y <= w, and z <= w, the near plane of reversed depth
    Planes planes{row(3) + row(0), row(3) - row(0), row(3) + row(1), row(3) - row(1), row(3) - row(2)};
    for (vec4& p : planes) p /= std::max(glm::length(vec3(p)), 1e-30f);
    return planes;
}

namespace {

bool outside(const Bounds& b, const Planes& planes)
{
    for (const vec4& p : planes) {
        const vec3 furthest(p.x >= 0 ? b.max.x : b.min.x, p.y >= 0 ? b.max.y : b.min.y, p.z >= 0 ? b.max.z : b.min.z);
        if (glm::dot(vec3(p), furthest) + p.w < 0.0f) return true;
    }
    return false;
}

} // namespace

gpu::VertexStream SceneGpu::position_stream() { return {12, {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}}}; }
gpu::VertexStream SceneGpu::attribute_stream()
{
    return {sizeof(gpu_layout::Attributes),
        {{1, 0, VK_FORMAT_R32_UINT, 0}, {2, 0, VK_FORMAT_R32G32_SFLOAT, 4}, {3, 0, VK_FORMAT_R32_UINT, 12}}};
}
gpu::VertexStream SceneGpu::previous_stream() { return {12, {{4, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}}}; }

uint64_t SceneGpu::draw(gpu::Encoder& encoder, const DrawOptions& options)
{
    const Impl& s = *impl_;
    if (options.pulled == 0) {
        encoder.vertex_buffer(0, s.positions);
        if (options.second == Second::attributes) encoder.vertex_buffer(1, s.attributes);
        if (options.second == Second::previous) encoder.vertex_buffer(1, previous_positions());
        encoder.index_buffer(s.indices);
    }
    std::vector<uint32_t> order;
    const auto kept = [&](const Slot& slot) {
        return !options.cull || (!outside(slot.bounds, *options.cull) && (!s.filter || s.filter(slot.instance, *options.cull)));
    };
    for (uint32_t i = 0; i < s.slots.size(); ++i)
        if ((s.slots[i].set & options.sets) != 0 && kept(s.slots[i])) order.push_back(i);
    if (options.back_to_front_of) {
        const auto distance = [&](uint32_t i) { return glm::length(s.slots[i].bounds.centre() - *options.back_to_front_of); };
        std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return distance(a) > distance(b); });
    }
    uint64_t triangles = 0;
    int culling = -1;
    for (size_t first = 0; first < order.size();) {
        // neighbours in the instance buffer with one mesh become one instanced draw
        const Slot& slot = s.slots[order[first]];
        size_t end = first + 1;
        while (end < order.size() && order[end] == order[end - 1] + 1 && s.slots[order[end]].mesh == slot.mesh) ++end;
        if (options.cull_back_faces && culling != int(slot.double_sided)) {
            culling = int(slot.double_sided);
            encoder.cull(slot.double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
        }
        const MeshRange& range = s.ranges[slot.mesh];
        const uint32_t count = uint32_t(end - first), first_instance = order[first] | options.layer << 24;
        if (options.pulled)
            encoder.draw(range.index_count / 3 * options.pulled, count, 0, first_instance);
        else
            encoder.draw_indexed(range.index_count, count, range.first_index, int32_t(range.first_vertex), first_instance);
        triangles += uint64_t(range.index_count / 3) * (end - first);
        first = end;
    }
    return triangles;
}

uint32_t SceneGpu::slot_count() const { return uint32_t(impl_->slots.size()); }

gpu::Buffer& SceneGpu::casters()
{
    Impl& s = *impl_;
    if (s.casters) return s.casters;
    std::vector<shaders::Caster> all;
    for (const Slot& slot : s.slots) {
        const MeshRange& range = s.ranges[slot.mesh];
        all.push_back({slot.bounds.min, slot.bounds.max, range.index_count, range.first_index, int32_t(range.first_vertex),
            uint32_t(slot.set == draw_blended)});
    }
    all.resize(std::max<size_t>(all.size(), 1));
    gpu::Buffer casters = s.device->buffer({all.size() * sizeof(shaders::Caster), 0, gpu::Memory::device, "casters"});
    s.device->upload(casters, std::as_bytes(std::span(all)));
    s.casters = std::move(casters); // not before it is filled: the upload may throw
    return s.casters;
}

void SceneGpu::draw_indirect(gpu::Encoder& encoder, const DrawOptions& options, gpu::BufferId commands, uint64_t offset)
{
    const Impl& s = *impl_;
    encoder.vertex_buffer(0, s.positions);
    if (options.second == Second::attributes) encoder.vertex_buffer(1, s.attributes);
    if (options.second == Second::previous) encoder.vertex_buffer(1, previous_positions());
    encoder.index_buffer(s.indices);
    constexpr uint32_t stride = sizeof(shaders::DrawCommand);
    for (uint32_t first = 0; first < s.slots.size();) {
        uint32_t end = first;
        // every device takes so many commands at once
        while (end < s.slots.size() && end - first < 65535 && (s.slots[end].set & options.sets) != 0) ++end;
        if (end > first) encoder.draw_indexed_indirect(commands, offset + uint64_t(first) * stride, end - first, stride);
        first = std::max(end, first + 1);
    }
}

std::vector<SceneGpu::Drawable> SceneGpu::drawables() const
{
    std::vector<Drawable> out;
    for (uint32_t i = 0; i < impl_->slots.size(); ++i) {
        const Slot& slot = impl_->slots[i];
        const MeshRange& range = impl_->ranges[slot.mesh];
        out.push_back({i, slot.instance, slot.mesh, range.first_index, range.index_count, range.first_vertex, slot.set});
    }
    return out;
}

const gpu::AccelerationStructure& SceneGpu::tlas()
{
    Impl& s = *impl_;
    if (s.tlas) return s.tlas;
    s.blas.resize(s.ranges.size());
    std::vector<gpu::TlasInstance> instances;
    for (size_t slot = 0; slot < s.slots.size(); ++slot) {
        const Slot& at = s.slots[slot];
        const MeshRange& range = s.ranges[at.mesh];
        if (at.set == draw_blended || range.index_count == 0) continue;
        gpu::AccelerationStructure& blas = s.blas[at.mesh];
        if (!blas)
            blas = s.device->build_blas({s.positions.address() + uint64_t(range.first_vertex) * 12, 12, range.vertex_count,
                s.indices.address() + uint64_t(range.first_index) * 4, range.index_count / 3, at.set == draw_opaque,
                s.scene->meshes[at.mesh].name});
        gpu::TlasInstance instance{&blas, {}, uint32_t(slot), 0xff, 0};
        const mat4& m = s.scene->instances[at.instance].world_from_object;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 4; ++c) instance.transform[r * 4 + c] = m[c][r];
        instances.push_back(instance);
    }
    s.tlas = s.device->build_tlas(instances);
    return s.tlas;
}

} // namespace gnomon::shadow
