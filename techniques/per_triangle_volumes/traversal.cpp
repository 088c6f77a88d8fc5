// SPDX-License-Identifier: Apache-2.0
#include "techniques/per_triangle_volumes/traversal.h"

#include <algorithm>
#include <string>

namespace gnomon::techniques::per_triangle_volumes {

using namespace shadow;

namespace {

/// Room in the list between the two passes. What does not fit is done in the first.
constexpr uint32_t most_entries = 1u << 20;

const gpu::Program& program(gpu::Device& device, const char* name, std::span<const gpu::SpecConstant> constants = {})
{
    return device.compute_program(std::string("techniques/per_triangle_volumes/per_triangle_volumes_") + name + ".comp", constants);
}

struct GroupConstants {
    uint which; ///< of the numbers in Work
    uint most;
    uint teams_are_groups;
};

} // namespace

gpu::Binding counting(const Frame& frame, const TreeBuffers& b) { return {b.counts, frame.counters ? gpu::Use::update : gpu::Use::store}; }

TreeBuffers make_buffers(gpu::PassList& passes, const Frame& frame, const Tree& tree, uint32_t volumes)
{
    const auto transient = [&](uint64_t bytes, const char* name, VkBufferUsageFlags usage = 0) {
        return passes.transient(gpu::BufferDesc{bytes, usage, gpu::Memory::device, name});
    };
    TreeBuffers b{};
    b.words = transient(4 * uint64_t(tree.nodes), "words");
    b.tiles = transient(4 * (32 * uint64_t(tree.nodes - tree.first[2]) + 1), "tiles");
    b.volumes = transient(volumes * sizeof(Volume), "volumes");
    b.work = transient(8, "work");
    b.room = std::min(most_entries, 64 * volumes);
    b.entries = transient(b.room * sizeof(uvec2), "entries");
    b.groups = transient(sizeof(VkDispatchIndirectCommand), "groups", VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    b.counts = transient(sizeof(Counts), "counts");
    if (!frame.counters) return b;
    passes.fill(b.counts, 0, "no counts");
    constexpr const char* names[] = {"triangles", "triangles_culled", "tile_tests", "sample_tests", "queue_entries"};
    for (uint32_t i = 0; i < std::size(names); ++i) frame.counters->push_back({names[i], b.counts, 4 * i});
    return b;
}

void traverse(gpu::PassList& passes, const Frame& frame, const TreeBuffers& b, const Traversal& t)
{
    SceneGpu& scene = frame.resources;
    for (const uint32_t phase : {PHASE_EXPAND, PHASE_DRAIN}) {
        passes.compute({.name = "groups",
            .program = &program(passes.device(), "groups"),
            .bindings = {{b.work, gpu::Use::load}, {b.groups, gpu::Use::store}},
            .constants = GroupConstants{phase, phase == PHASE_EXPAND ? ~0u : b.room, uint(t.teams_are_groups)}});
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
