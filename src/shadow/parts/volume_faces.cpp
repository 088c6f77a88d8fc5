// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volume_faces.h"

#include "shadow/light_constants.h"

#include <algorithm>

namespace gnomon::shadow::parts {

namespace {

using gpu::Use;

/// So many blocks are turned into faces and drawn at once, so that memory is bounded by them and not by the scene.
constexpr uint32_t step_blocks = (1u << 20) / VOLUME_GROUP;

gpu::Threads groups(uint32_t count)
{
    constexpr uint32_t row = 1u << 15; // half of the groups that every device can run along an axis
    return {std::min(count, row) * VOLUME_GROUP, (count + row - 1) / row, 1};
}

gpu::BufferId buffer(gpu::PassList& passes, uint64_t bytes, const char* name, VkBufferUsageFlags usage = 0)
{
    return passes.transient(gpu::BufferDesc{std::max<uint64_t>(bytes, 16), usage, gpu::Memory::device, name});
}

} // namespace

VolumeFaces::VolumeFaces(gpu::PassList& passes, const Frame& frame, VolumeCasters& casters, const VolumeSettings& settings, bool repeated)
    : passes_(passes)
    , casters_(casters)
    , slot_bands_(settings.slot_bands)
    , counted_(frame.counters ? 1u : 0u)
    , repeated_(repeated ? 1u : 0u)
{
    task.view = view_constants(frame.view, frame.index);
    task.light = light_constants(frame.light, frame.resources.bounds());
    task.edges = uint32_t(settings.edges), task.count = uint32_t(settings.count);
    if (settings.bands && settings.slot_bands) task.bands = *settings.bands;
    instances_ = passes.import(frame.resources.instances());
    positions_ = passes.import(frame.resources.positions());
    indices_ = passes.import(frame.resources.indices());
    // all that one step can make; repeated for a stencil, three sides a triangle
    const uint64_t most_quads = uint64_t(std::min(casters.edge_block_count, step_blocks)) * VOLUME_GROUP;
    const uint64_t most_caps = uint64_t(std::min(casters.triangle_block_count, step_blocks)) * VOLUME_GROUP;
    quads = buffer(
        passes, std::max(most_quads, uint64_t(repeated ? 3 * casters.triangles : 0)) * sizeof(shaders::VolumeQuad), "volume quads");
    caps = buffer(passes, most_caps * sizeof(shaders::VolumeCap), "volume caps");
    sides = buffer(passes, uint64_t(casters.primitives) * 4, "triangles' sides");
    draws = buffer(passes, VOLUME_DRAWS * sizeof(VkDrawIndirectCommand), "draws of volumes", VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    work = buffer(passes, sizeof(shaders::VolumeWork), "volumes' work");
}

void VolumeFaces::begin()
{
    passes_.fill(work, 0, "no work yet");
    // scenes may have no caster
    if (casters_.edge_block_count == 0) passes_.fill(quads, 0, "no quads");
    if (casters_.triangle_block_count == 0) {
        passes_.fill(caps, 0, "no caps");
        return passes_.fill(sides, 0, "no triangles");
    }
    gpu::ComputePass pass = each_triangle("sides", "src/shadow/parts/volume_sides.comp", {});
    pass.bindings.push_back({sides, Use::store});
    passes_.compute(std::move(pass));
}

uint32_t VolumeFaces::steps() const
{
    const uint32_t most = std::max({casters_.edge_block_count, casters_.triangle_block_count, 1u});
    return (most + step_blocks - 1) / step_blocks;
}

shaders::VolumeTask VolumeFaces::part(uint32_t first, uint32_t count, uint32_t most) const
{
    shaders::VolumeTask part = task;
    part.first_block = first, part.blocks = first < count ? std::min(count - first, most) : 0;
    return part;
}

gpu::ComputePass VolumeFaces::each_triangle(const char* name, const char* shader, std::span<const gpu::SpecConstant> modes)
{
    return triangles(name, shader, modes, 0, ~0u);
}

gpu::ComputePass VolumeFaces::triangles(
    const char* name, const char* shader, std::span<const gpu::SpecConstant> modes, uint32_t first, uint32_t most)
{
    const shaders::VolumeTask some = part(first, casters_.triangle_block_count, most);
    return {.name = name,
        .program = &passes_.device().compute_program(shader, modes),
        .bindings
        = {{instances_, Use::load}, {indices_, Use::load}, {positions_, Use::load}, {passes_.import(casters_.triangle_blocks), Use::load}},
        .constants = some,
        .threads = groups(some.blocks)};
}

gpu::BufferId VolumeFaces::slot_bands() const { return task.bands.count ? slot_bands_ : sides; }

void VolumeFaces::make(uint32_t step)
{
    const uint32_t first = step * step_blocks;
    gpu::Device& device = passes_.device();
    passes_.compute({.name = "begin",
        .program = &device.compute_program("src/shadow/parts/volume_begin.comp"),
        .bindings = {{draws, Use::store}},
        .threads = {VOLUME_DRAWS, 1, 1}});
    const gpu::SpecConstant modes[] = {{0, task.edges}, {1, counted_}, {2, repeated_}};
    const shaders::VolumeTask of_edges = part(first, casters_.edge_block_count, step_blocks);
    if (of_edges.blocks)
        passes_.compute({.name = "silhouettes",
            .program = &device.compute_program("src/shadow/parts/volume_quads.comp", modes),
            .bindings = {{instances_, Use::load}, {positions_, Use::load}, {passes_.import(casters_.edge_blocks), Use::load},
                {sides, Use::load}, {passes_.import(casters_.edges), Use::load}, {passes_.import(casters_.lists), Use::load},
                {quads, Use::store}, {draws, Use::update}, {work, Use::update}, {slot_bands(), Use::load}},
            .constants = of_edges,
            .threads = groups(of_edges.blocks)});
    gpu::ComputePass of_triangles = triangles("caps", "src/shadow/parts/volume_caps.comp", modes, first, step_blocks);
    of_triangles.bindings.insert(of_triangles.bindings.end(),
        {{sides, Use::load}, {caps, Use::store}, {draws, Use::update}, {work, Use::update}, {slot_bands(), Use::load}});
    if (of_triangles.threads.x) passes_.compute(std::move(of_triangles));
}

} // namespace gnomon::shadow::parts
