// SPDX-License-Identifier: Apache-2.0
#include "techniques/per_triangle_volumes/traversal.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace gnomon::techniques::per_triangle_volumes {

using namespace shadow;

namespace {

const gpu::Program& program(gpu::Device& device, const char* name, std::span<const gpu::SpecConstant> constants = {})
{
    return device.compute_program(std::string("techniques/per_triangle_volumes/per_triangle_volumes_") + name + ".comp", constants);
}

struct GroupConstants {
    uint which; ///< of the numbers in Work
    uint most;
    uint one_a_group;
};

} // namespace

gpu::Binding counting(const Frame& frame, const TreeBuffers& b) { return {b.counts, frame.counters ? gpu::Use::update : gpu::Use::store}; }

TreeBuffers make_buffers(gpu::PassList& passes, const Frame& frame, const Tree& tree, uint32_t volumes, uint32_t entries)
{
    const auto transient = [&](uint64_t bytes, const char* name, VkBufferUsageFlags usage = 0) {
        return passes.transient(gpu::BufferDesc{bytes, usage, gpu::Memory::device, name});
    };
    TreeBuffers b{};
    b.words = transient(4 * uint64_t(tree.nodes), "words");
    b.tiles = transient(4 * (32 * uint64_t(tree.nodes - tree.first[2]) + 1), "tiles");
    b.volumes = transient(volumes * sizeof(Volume), "volumes");
    b.work = transient(12, "work");
    b.room = std::max(entries, 1u);
    b.entries = transient(b.room * sizeof(uvec2), "entries");
    b.kept = transient(4 * uint64_t(volumes), "kept blocks");
    b.groups = transient(sizeof(VkDispatchIndirectCommand), "groups", VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    b.counts = transient(sizeof(Counts), "counts");
    if (!frame.counters) return b;
    passes.fill(b.counts, 0, "no counts");
    constexpr const char* names[] = {"triangles", "triangles_culled", "tile_tests", "sample_tests", "queue_entries", "blocks_culled"};
    for (uint32_t i = 0; i < std::size(names); ++i) frame.counters->push_back({names[i], b.counts, 4 * i});
    return b;
}

void find_groups(gpu::PassList& passes, const TreeBuffers& b, WorkNumber number, uint32_t most, bool one_a_group)
{
    passes.compute({.name = "groups",
        .program = &program(passes.device(), "groups"),
        .bindings = {{b.work, gpu::Use::load}, {b.groups, gpu::Use::store}},
        .constants = GroupConstants{uint(number), most, uint(one_a_group)}});
}

void traverse(gpu::PassList& passes, const Frame& frame, const TreeBuffers& b, const Traversal& t)
{
    SceneGpu& scene = frame.resources;
    for (const uint32_t phase : {PHASE_EXPAND, PHASE_DRAIN}) {
        if (phase == PHASE_EXPAND)
            find_groups(passes, b, WorkNumber::volumes, ~0u, t.teams_are_groups);
        else
            find_groups(passes, b, WorkNumber::entries, b.room, t.teams_are_groups);
        std::vector<gpu::SpecConstant> specialised = t.specialised;
        specialised.push_back({1, uint32_t(frame.counters != nullptr)});
        specialised.push_back({3, phase});
        gpu::ComputePass pass{.name = phase == PHASE_EXPAND ? "expand" : "drain",
            .program = &program(passes.device(), t.shader, specialised),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.primitive, gpu::Use::sample}, {b.words, gpu::Use::update},
                {b.tiles, gpu::Use::load}, {b.volumes, gpu::Use::load}, {b.work, gpu::Use::update},
                {b.entries, phase == PHASE_EXPAND ? gpu::Use::store : gpu::Use::load}, {passes.import(scene.instances()), gpu::Use::load},
                {passes.import(scene.indices()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load},
                {passes.import(scene.attributes()), gpu::Use::load}, counting(frame, b)},
            .constants = t.constants,
            .textures = &scene.textures(),
            .indirect = b.groups};
        pass.bindings.insert(pass.bindings.end(), t.bindings.begin(), t.bindings.end());
        passes.compute(std::move(pass));
    }
}

} // namespace gnomon::techniques::per_triangle_volumes
