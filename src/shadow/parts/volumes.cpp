// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volumes.h"

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

class Volumes {
public:
    Volumes(gpu::PassList& passes, const Frame& frame, VolumeCasters& casters, const VolumeSettings& settings)
        : passes_(passes)
        , frame_(frame)
        , casters_(casters)
        , settings_(settings)
        , device_(passes.device())
        , counted_(frame.counters ? 1u : 0u)
    {
        task_.view = view_constants(frame.view, frame.index);
        task_.light = light_constants(frame.light, frame.resources.bounds());
        task_.edges = uint32_t(settings.edges), task_.count = uint32_t(settings.count);
        // a sun's volumes end in one point
        task_.far_caps = settings.count == VolumeCount::zfail && frame.light.kind() != scene::LightKind::directional;
        instances_ = passes.import(frame.resources.instances());
        positions_ = passes.import(frame.resources.positions());
        indices_ = passes.import(frame.resources.indices());
        quads_ = buffer(
            passes, uint64_t(std::min(casters.edge_block_count, step_blocks)) * VOLUME_GROUP * sizeof(shaders::VolumeQuad), "volume quads");
        caps_ = buffer(passes, uint64_t(std::min(casters.triangle_block_count, step_blocks)) * VOLUME_GROUP * sizeof(shaders::VolumeCap),
            "volume caps");
        sides_ = buffer(passes, uint64_t(casters.primitives) * 4, "triangles' sides");
        draws_ = buffer(passes, VOLUME_DRAWS * sizeof(VkDrawIndirectCommand), "draws of volumes", VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
        work_ = buffer(passes, sizeof(shaders::VolumeWork), "volumes' work");
    }

    VolumeCounts count()
    {
        passes_.fill(work_, 0, "no work yet");
        if (counted_) count_work();
        const VolumeCounts out{list_receivers(), image(VK_FORMAT_R32_SFLOAT, "volume counts")};
        find_sides();
        const uint32_t most = std::max({casters_.edge_block_count, casters_.triangle_block_count, 1u});
        for (uint32_t first = 0; first < most; first += step_blocks) {
            make_faces(first);
            draw_faces(out, first == 0 ? gpu::Load::clear : gpu::Load::keep);
        }
        return out;
    }

private:
    gpu::ImageId image(VkFormat format, const char* name)
    {
        return passes_.transient(gpu::ImageDesc{format, frame_.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
    }

    void count_work()
    {
        const auto add = [&](const char* name, size_t offset) { frame_.counters->push_back({name, work_, uint32_t(offset)}); };
        add("stencil_updates", offsetof(shaders::VolumeWork, updates));
        add("fragments", offsetof(shaders::VolumeWork, fragments));
        add("volume_quads", offsetof(shaders::VolumeWork, quads));
        add("caps", offsetof(shaders::VolumeWork, caps));
    }

    gpu::ImageId list_receivers()
    {
        const gpu::ImageId receivers = image(VK_FORMAT_R32G32B32A32_SFLOAT, "receivers");
        passes_.fullscreen({.name = "receivers",
            .program = &device_.raster_program("shaders/fullscreen.vert", "src/shadow/parts/volume_receivers.frag"),
            .bindings = {{frame_.gbuffer.depth, Use::sample}, {frame_.gbuffer.normal, Use::sample}},
            .constants = task_,
            .colors = {{receivers, gpu::Load::discard}}});
        return receivers;
    }

    void find_sides()
    {
        if (casters_.triangle_block_count == 0) return;
        shaders::VolumeTask task = task_;
        task.blocks = casters_.triangle_block_count;
        passes_.compute({.name = "sides",
            .program = &device_.compute_program("src/shadow/parts/volume_sides.comp"),
            .bindings = {{instances_, Use::load}, {indices_, Use::load}, {positions_, Use::load},
                {passes_.import(casters_.triangle_blocks), Use::load}, {sides_, Use::store}},
            .constants = task,
            .threads = groups(task.blocks)});
    }

    /// Quads and caps of so many blocks from `first` on.
    void make_faces(uint32_t first)
    {
        const auto step = [&](uint32_t count) {
            shaders::VolumeTask task = task_;
            task.first_block = first, task.blocks = first < count ? std::min(count - first, step_blocks) : 0;
            return task;
        };
        passes_.compute({.name = "begin",
            .program = &device_.compute_program("src/shadow/parts/volume_begin.comp"),
            .bindings = {{draws_, Use::store}},
            .threads = {VOLUME_DRAWS, 1, 1}});
        const gpu::SpecConstant modes[] = {{0, task_.edges}, {1, counted_}};
        const shaders::VolumeTask of_edges = step(casters_.edge_block_count), of_triangles = step(casters_.triangle_block_count);
        if (of_edges.blocks)
            passes_.compute({.name = "silhouettes",
                .program = &device_.compute_program("src/shadow/parts/volume_quads.comp", modes),
                .bindings = {{instances_, Use::load}, {positions_, Use::load}, {passes_.import(casters_.edge_blocks), Use::load},
                    {sides_, Use::load}, {passes_.import(casters_.edges), Use::load}, {passes_.import(casters_.lists), Use::load},
                    {quads_, Use::store}, {draws_, Use::update}, {work_, Use::update}},
                .constants = of_edges,
                .threads = groups(of_edges.blocks)});
        if (of_triangles.blocks)
            passes_.compute({.name = "caps",
                .program = &device_.compute_program("src/shadow/parts/volume_caps.comp", modes),
                .bindings = {{instances_, Use::load}, {indices_, Use::load}, {positions_, Use::load},
                    {passes_.import(casters_.triangle_blocks), Use::load}, {sides_, Use::load}, {caps_, Use::store}, {draws_, Use::update},
                    {work_, Use::update}},
                .constants = of_triangles,
                .threads = groups(of_triangles.blocks)});
    }

    void draw_faces(const VolumeCounts& out, gpu::Load load)
    {
        VkPipelineColorBlendAttachmentState add{};
        add.blendEnable = VK_TRUE;
        add.colorWriteMask = 0xf;
        add.srcColorBlendFactor = add.dstColorBlendFactor = add.srcAlphaBlendFactor = add.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        add.colorBlendOp = add.alphaBlendOp = VK_BLEND_OP_ADD;
        const gpu::SpecConstant modes[] = {{1, counted_}};
        passes_.raster({.name = "volumes",
            .program = &device_.raster_program("src/shadow/parts/volume_faces.vert", "src/shadow/parts/volume_faces.frag", modes),
            .bindings = {{quads_, Use::load}, {caps_, Use::load}, {out.receivers, Use::sample}, {work_, Use::update}},
            .constants = task_,
            .colors = {{.image = out.counts, .load = load, .blend = add}},
            .buffers = {{draws_, Use::indirect}},
            .draw = [draws = draws_](gpu::Encoder& encoder) {
                for (uint32_t i = 0; i < VOLUME_DRAWS; ++i)
                    encoder.draw_indirect(draws, i * sizeof(VkDrawIndirectCommand), 1, sizeof(VkDrawIndirectCommand));
            }});
    }

    gpu::PassList& passes_;
    const Frame& frame_;
    VolumeCasters& casters_;
    const VolumeSettings& settings_;
    gpu::Device& device_;
    uint32_t counted_; ///< 0 or 1
    shaders::VolumeTask task_{};
    gpu::BufferId instances_, positions_, indices_, quads_, caps_, sides_, draws_, work_;
};

} // namespace

VolumeCounts count_volumes(gpu::PassList& passes, const Frame& frame, VolumeCasters& casters, const VolumeSettings& settings)
{
    casters.update(frame.resources);
    return Volumes(passes, frame, casters, settings).count();
}

void resolve_volumes(gpu::PassList& passes, const Frame& frame, const VolumeCounts& counts)
{
    passes.fullscreen({.name = "resolve",
        .program = &passes.device().raster_program("shaders/fullscreen.vert", "src/shadow/parts/volume_resolve.frag"),
        .bindings = {{counts.receivers, Use::sample}, {counts.counts, Use::sample}},
        .colors = {{frame.output}}});
}

} // namespace gnomon::shadow::parts
