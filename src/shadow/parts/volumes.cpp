// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volumes.h"

#include "shadow/light_constants.h"
#include "shadow/parts/volume_states.h"

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

/// A count is at most the number of casting triangles, whose volumes each count once. It begins at 0, which along parallel rays it does not
/// at infinity (count_at_eye).
bool takes_stencil(const VolumeSettings& s, const VolumeCasters& casters, const scene::View& view)
{
    if (s.count == VolumeCount::zfail && view.orthographic) return false;
    const bool can = !s.transmittance && (s.count == VolumeCount::zpass || s.count == VolumeCount::zfail) && casters.triangles < 256;
    return can && s.counter == VolumeCounter::stencil && s.order == VolumeOrder::planes;
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
        , stencil_(takes_stencil(settings, casters, frame.view))
    {
        task_.view = view_constants(frame.view, frame.index);
        task_.light = light_constants(frame.light, frame.resources.bounds());
        task_.edges = uint32_t(settings.edges), task_.count = uint32_t(settings.count);
        set_ends();
        if (settings.bands && settings.slot_bands) task_.bands = *settings.bands;
        instances_ = passes.import(frame.resources.instances());
        positions_ = passes.import(frame.resources.positions());
        indices_ = passes.import(frame.resources.indices());
        weights_ = passes.import(casters.weights);
        // all that one step can make; repeated for a stencil, three sides a triangle
        const uint64_t quads = uint64_t(std::min(casters.edge_block_count, step_blocks)) * VOLUME_GROUP;
        const uint64_t caps = uint64_t(std::min(casters.triangle_block_count, step_blocks)) * VOLUME_GROUP;
        quads_
            = buffer(passes, std::max(quads, uint64_t(stencil_ ? 3 * casters.triangles : 0)) * sizeof(shaders::VolumeQuad), "volume quads");
        caps_ = buffer(passes, caps * sizeof(shaders::VolumeCap), "volume caps");
        sides_ = buffer(passes, uint64_t(casters.primitives) * 4, "triangles' sides");
        draws_ = buffer(passes, VOLUME_DRAWS * sizeof(VkDrawIndirectCommand), "draws of volumes", VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
        work_ = buffer(passes, sizeof(shaders::VolumeWork), "volumes' work");
        eye_ = buffer(passes, 16, "volumes at the eye");
    }

    VolumeCounts count()
    {
        passes_.fill(work_, 0, "no work yet");
        passes_.fill(eye_, 0, "no volume at the eye");
        if (counted_) count_work();
        const VkFormat format = stencil_ ? VK_FORMAT_D32_SFLOAT_S8_UINT
            : settings_.transmittance    ? VK_FORMAT_R32G32B32A32_SFLOAT
                                         : VK_FORMAT_R32_SFLOAT;
        const VolumeCounts out{list_receivers(), image(format, "volume counts"), eye_, stencil_};
        if (settings_.decided && !stencil_ && settings_.order == VolumeOrder::planes) undecided_ = draw_undecided();
        // scenes may have no caster
        if (casters_.edge_block_count == 0) passes_.fill(quads_, 0, "no quads");
        if (casters_.triangle_block_count == 0) passes_.fill(caps_, 0, "no caps");
        find_sides();
        if (settings_.count == VolumeCount::pp_zp) count_at_eye("volumes at the eye");
        if (settings_.count == VolumeCount::zfail && frame_.view.orthographic && !task_.along_view) count_at_eye("volumes at infinity");
        const uint32_t most = std::max({casters_.edge_block_count, casters_.triangle_block_count, 1u});
        for (uint32_t first = 0; first < most; first += step_blocks) {
            make_faces(first);
            gpu::Load load = first == 0 ? gpu::Load::clear : gpu::Load::keep;
            if (settings_.count == VolumeCount::zp_plus) {
                count_at_near_plane(out, load);
                load = gpu::Load::keep;
            }
            draw_faces(out, load);
        }
        return out;
    }

private:
    gpu::ImageId image(VkFormat format, const char* name)
    {
        return passes_.transient(gpu::ImageDesc{format, frame_.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
    }
    uint32_t coloured() const { return settings_.transmittance ? 1 : 0; }

    /// Far caps close volumes where they end in more than a point. Parallel rays of the eye, too, end in one point, so that what lies there
    /// is a number (count_at_eye); unless the light's are the same rays.
    void set_ends()
    {
        const bool sun = frame_.light.kind() == scene::LightKind::directional, parallel = frame_.view.orthographic;
        task_.along_view = parallel && sun && glm::length(glm::cross(task_.light.direction, task_.view.forward)) < 1e-6f;
        const bool away = glm::dot(task_.light.direction, task_.view.forward) > 0.0f;
        task_.far_caps = settings_.count == VolumeCount::zfail && (task_.along_view ? away : !sun && !parallel);
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
        const gpu::SpecConstant some[] = {{0, settings_.decided ? 1u : 0u}};
        passes_.fullscreen({.name = "receivers",
            .program = &device_.raster_program("shaders/fullscreen.vert", "src/shadow/parts/volume_receivers.frag", some),
            .bindings = {{frame_.gbuffer.depth, Use::sample}, {frame_.gbuffer.normal, Use::sample},
                {settings_.decided ? settings_.decided : frame_.gbuffer.depth, Use::sample}},
            .constants = task_,
            .colors = {{receivers, gpu::Load::discard}}});
        return receivers;
    }

    /// 1 in the stencil where something is to be counted: the rasteriser then turns all other fragments away before their shader runs.
    gpu::ImageId draw_undecided()
    {
        const gpu::ImageId undecided = image(VK_FORMAT_D32_SFLOAT_S8_UINT, "undecided");
        const VkStencilOpState one{VK_STENCIL_OP_KEEP, VK_STENCIL_OP_REPLACE, VK_STENCIL_OP_KEEP, VK_COMPARE_OP_ALWAYS, 0xff, 0xff, 1};
        gpu::RasterPass pass{.name = "undecided",
            .program = &device_.raster_program("shaders/fullscreen.vert", "src/shadow/parts/volume_undecided.frag"),
            .bindings = {{settings_.decided, Use::sample}},
            .depth = gpu::DepthTarget{.image = undecided,
                .write = false,
                .compare = VK_COMPARE_OP_ALWAYS,
                .stencil = true,
                .front = one,
                .back = one},
            .draw = [](gpu::Encoder& encoder) { encoder.draw(3); }};
        passes_.raster(std::move(pass));
        return undecided;
    }

    shaders::VolumeTask step(uint32_t first, uint32_t count, uint32_t most) const
    {
        shaders::VolumeTask task = task_;
        task.first_block = first, task.blocks = first < count ? std::min(count - first, most) : 0;
        return task;
    }

    gpu::ComputePass each_triangle(
        const char* name, const char* shader, std::span<const gpu::SpecConstant> modes, uint32_t first, uint32_t most)
    {
        const shaders::VolumeTask task = step(first, casters_.triangle_block_count, most);
        return {.name = name,
            .program = &device_.compute_program(shader, modes),
            .bindings = {{instances_, Use::load}, {indices_, Use::load}, {positions_, Use::load},
                {passes_.import(casters_.triangle_blocks), Use::load}},
            .constants = task,
            .threads = groups(task.blocks)};
    }

    void find_sides()
    {
        if (casters_.triangle_block_count == 0) return passes_.fill(sides_, 0, "no triangles");
        gpu::ComputePass pass = each_triangle("sides", "src/shadow/parts/volume_sides.comp", {}, 0, ~0u);
        pass.bindings.push_back({sides_, Use::store});
        passes_.compute(std::move(pass));
    }

    void count_at_eye(const char* name)
    {
        if (casters_.triangle_block_count == 0) return;
        const gpu::SpecConstant modes[] = {{0, coloured()}};
        gpu::ComputePass pass = each_triangle(name, "src/shadow/parts/volume_eye.comp", modes, 0, ~0u);
        pass.bindings.insert(pass.bindings.end(), {{sides_, Use::load}, {weights_, Use::load}, {eye_, Use::update}});
        passes_.compute(std::move(pass));
    }

    /// By all triangles that are caps.
    void count_at_near_plane(const VolumeCounts& out, gpu::Load load)
    {
        const gpu::SpecConstant modes[] = {{0, coloured()}};
        passes_.raster({.name = "volumes at the near plane",
            .program = &device_.raster_program("src/shadow/parts/volume_near.vert", "src/shadow/parts/volume_near.frag", modes),
            .bindings = {{caps_, Use::load}, {weights_, Use::load}},
            .constants = task_,
            .colors = {{.image = out.counts, .load = load, .blend = volume_adding()}},
            .buffers = {{draws_, Use::indirect}},
            .draw = [draws = draws_](gpu::Encoder& encoder) {
                constexpr uint32_t one = sizeof(VkDrawIndirectCommand);
                encoder.draw_indirect(draws, VOLUME_NEAR_CAPS * one, 1, one);
            }});
    }

    /// Quads and caps of so many blocks from `first` on.
    void make_faces(uint32_t first)
    {
        passes_.compute({.name = "begin",
            .program = &device_.compute_program("src/shadow/parts/volume_begin.comp"),
            .bindings = {{draws_, Use::store}},
            .threads = {VOLUME_DRAWS, 1, 1}});
        const gpu::SpecConstant modes[] = {{0, task_.edges}, {1, counted_}, {2, stencil_ ? 1u : 0u}};
        const shaders::VolumeTask of_edges = step(first, casters_.edge_block_count, step_blocks);
        if (of_edges.blocks)
            passes_.compute({.name = "silhouettes",
                .program = &device_.compute_program("src/shadow/parts/volume_quads.comp", modes),
                .bindings = {{instances_, Use::load}, {positions_, Use::load}, {passes_.import(casters_.edge_blocks), Use::load},
                    {sides_, Use::load}, {passes_.import(casters_.edges), Use::load}, {passes_.import(casters_.lists), Use::load},
                    {quads_, Use::store}, {draws_, Use::update}, {work_, Use::update}, {slot_bands(), Use::load}},
                .constants = of_edges,
                .threads = groups(of_edges.blocks)});
        gpu::ComputePass caps = each_triangle("caps", "src/shadow/parts/volume_caps.comp", modes, first, step_blocks);
        caps.bindings.insert(caps.bindings.end(),
            {{sides_, Use::load}, {caps_, Use::store}, {draws_, Use::update}, {work_, Use::update}, {slot_bands(), Use::load}});
        if (caps.threads.x) passes_.compute(std::move(caps));
    }

    /// In their place, where there are none, what is as long.
    gpu::BufferId slot_bands() const { return task_.bands.count ? settings_.slot_bands : sides_; }

    void draw_faces(const VolumeCounts& out, gpu::Load load)
    {
        const bool by_depth = settings_.order == VolumeOrder::depth && !undecided_, zfail = settings_.count == VolumeCount::zfail;
        const gpu::SpecConstant modes[] = {{0, coloured()}, {1, counted_}, {2, by_depth ? 1u : 0u}};
        const bool clipped = settings_.count == VolumeCount::zp_plus || task_.bands.count > 0;
        const char* faces = clipped ? "src/shadow/parts/volume_faces_clipped.vert" : "src/shadow/parts/volume_faces.vert";
        const char* change = by_depth ? "src/shadow/parts/volume_faces_depth.frag"
            : undecided_              ? "src/shadow/parts/volume_faces_open.frag"
                                      : "src/shadow/parts/volume_faces.frag";
        gpu::RasterPass pass{.name = stencil_ ? "volumes (stencil)" : "volumes",
            .program = &device_.raster_program(faces, change, modes),
            .bindings
            = {{quads_, Use::load}, {caps_, Use::load}, {out.receivers, Use::sample}, {work_, Use::update}, {weights_, Use::load}},
            .constants = task_,
            .depth_clamp = by_depth,
            .buffers = {{draws_, Use::indirect}}};
        if (clipped) pass.bindings.push_back({slot_bands(), Use::load});
        if (!stencil_) pass.colors = {{.image = out.counts, .load = load, .blend = volume_adding()}};
        if (stencil_)
            pass.depth = volume_stencil(out.counts, load, zfail);
        else if (by_depth)
            pass.depth = volume_depth_test(frame_.gbuffer.depth, zfail);
        else if (undecided_)
            pass.depth = volume_where_one(undecided_);
        pass.draw = [draws = draws_, area = area()](gpu::Encoder& encoder) {
            encoder.scissor(area.x, area.y, area.width, area.height);
            for (uint32_t i = 0; i < VOLUME_DRAWS; ++i)
                encoder.draw_indirect(draws, i * sizeof(VkDrawIndirectCommand), 1, sizeof(VkDrawIndirectCommand));
        };
        passes_.raster(std::move(pass));
    }

    PixelRectangle area() const
    {
        const gpu::Size size = frame_.view.size;
        if (!settings_.scissor) return {0, 0, uint32_t(size.width), uint32_t(size.height)};
        return lit_rectangle(frame_.view, frame_.light, frame_.resources.bounds());
    }

    gpu::PassList& passes_;
    const Frame& frame_;
    VolumeCasters& casters_;
    const VolumeSettings& settings_;
    gpu::Device& device_;
    uint32_t counted_; ///< 0 or 1
    bool stencil_;
    shaders::VolumeTask task_{};
    gpu::ImageId undecided_{}; ///< a stencil
    gpu::BufferId instances_, positions_, indices_, weights_, quads_, caps_, sides_, draws_, work_, eye_;
};

} // namespace

VolumeCounts count_volumes(gpu::PassList& passes, const Frame& frame, VolumeCasters& casters, const VolumeSettings& settings)
{
    casters.update(frame.resources, settings.transmittance);
    return Volumes(passes, frame, casters, settings).count();
}

} // namespace gnomon::shadow::parts
