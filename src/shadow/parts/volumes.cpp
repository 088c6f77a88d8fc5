// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volumes.h"

#include "shadow/parts/volume_faces.h"
#include "shadow/parts/volume_states.h"

#include <algorithm>

namespace gnomon::shadow::parts {

namespace {

using gpu::Use;

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
        , faces_(passes, frame, casters, settings, stencil_)
    {
        set_ends();
        weights_ = passes.import(casters.weights);
        eye_ = passes.transient(gpu::BufferDesc{16, 0, gpu::Memory::device, "volumes at the eye"});
    }

    VolumeCounts count()
    {
        passes_.fill(eye_, 0, "no volume at the eye");
        if (counted_) count_work();
        const VkFormat format = stencil_ ? VK_FORMAT_D32_SFLOAT_S8_UINT
            : settings_.transmittance    ? VK_FORMAT_R32G32B32A32_SFLOAT
                                         : VK_FORMAT_R32_SFLOAT;
        const VolumeCounts out{list_receivers(), image(format, "volume counts"), eye_, stencil_};
        if (settings_.decided && !stencil_ && settings_.order == VolumeOrder::planes) undecided_ = draw_undecided();
        faces_.begin();
        if (settings_.count == VolumeCount::pp_zp) count_at_eye("volumes at the eye");
        if (settings_.count == VolumeCount::zfail && frame_.view.orthographic && !faces_.task.along_view)
            count_at_eye("volumes at infinity");
        for (uint32_t step = 0; step < faces_.steps(); ++step) {
            faces_.make(step);
            gpu::Load load = step == 0 ? gpu::Load::clear : gpu::Load::keep;
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
        faces_.task.along_view = parallel && sun && glm::length(glm::cross(faces_.task.light.direction, faces_.task.view.forward)) < 1e-6f;
        const bool away = glm::dot(faces_.task.light.direction, faces_.task.view.forward) > 0.0f;
        faces_.task.far_caps = settings_.count == VolumeCount::zfail && (faces_.task.along_view ? away : !sun && !parallel);
    }

    void count_work()
    {
        const auto add = [&](const char* name, size_t offset) { frame_.counters->push_back({name, faces_.work, uint32_t(offset)}); };
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
            .constants = faces_.task,
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

    void count_at_eye(const char* name)
    {
        if (casters_.triangle_block_count == 0) return;
        const gpu::SpecConstant modes[] = {{0, coloured()}};
        gpu::ComputePass pass = faces_.each_triangle(name, "src/shadow/parts/volume_eye.comp", modes);
        pass.bindings.insert(pass.bindings.end(), {{faces_.sides, Use::load}, {weights_, Use::load}, {eye_, Use::update}});
        passes_.compute(std::move(pass));
    }

    /// By all triangles that are caps.
    void count_at_near_plane(const VolumeCounts& out, gpu::Load load)
    {
        const gpu::SpecConstant modes[] = {{0, coloured()}};
        passes_.raster({.name = "volumes at the near plane",
            .program = &device_.raster_program("src/shadow/parts/volume_near.vert", "src/shadow/parts/volume_near.frag", modes),
            .bindings = {{faces_.caps, Use::load}, {weights_, Use::load}},
            .constants = faces_.task,
            .colors = {{.image = out.counts, .load = load, .blend = volume_adding()}},
            .buffers = {{faces_.draws, Use::indirect}},
            .draw = [draws = faces_.draws](gpu::Encoder& encoder) {
                constexpr uint32_t one = sizeof(VkDrawIndirectCommand);
                encoder.draw_indirect(draws, VOLUME_NEAR_CAPS * one, 1, one);
            }});
    }

    void draw_faces(const VolumeCounts& out, gpu::Load load)
    {
        const bool by_depth = settings_.order == VolumeOrder::depth && !undecided_, zfail = settings_.count == VolumeCount::zfail;
        const gpu::SpecConstant modes[] = {{0, coloured()}, {1, counted_}, {2, by_depth ? 1u : 0u}};
        const bool clipped = settings_.count == VolumeCount::zp_plus || faces_.task.bands.count > 0;
        const char* faces = clipped ? "src/shadow/parts/volume_faces_clipped.vert" : "src/shadow/parts/volume_faces.vert";
        const char* change = by_depth ? "src/shadow/parts/volume_faces_depth.frag"
            : undecided_              ? "src/shadow/parts/volume_faces_open.frag"
                                      : "src/shadow/parts/volume_faces.frag";
        gpu::RasterPass pass{.name = stencil_ ? "volumes (stencil)" : "volumes",
            .program = &device_.raster_program(faces, change, modes),
            .bindings = {{faces_.quads, Use::load}, {faces_.caps, Use::load}, {out.receivers, Use::sample}, {faces_.work, Use::update},
                {weights_, Use::load}},
            .constants = faces_.task,
            .depth_clamp = by_depth,
            .buffers = {{faces_.draws, Use::indirect}}};
        if (clipped) pass.bindings.push_back({faces_.slot_bands(), Use::load});
        if (!stencil_) pass.colors = {{.image = out.counts, .load = load, .blend = volume_adding()}};
        if (stencil_)
            pass.depth = volume_stencil(out.counts, load, zfail);
        else if (by_depth)
            pass.depth = volume_depth_test(frame_.gbuffer.depth, zfail);
        else if (undecided_)
            pass.depth = volume_where_one(undecided_);
        pass.draw = [draws = faces_.draws, area = area()](gpu::Encoder& encoder) {
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
    VolumeFaces faces_;
    gpu::ImageId undecided_{}; ///< a stencil
    gpu::BufferId weights_, eye_;
};

} // namespace

VolumeCounts count_volumes(gpu::PassList& passes, const Frame& frame, VolumeCasters& casters, const VolumeSettings& settings)
{
    casters.update(frame.resources, settings.transmittance);
    return Volumes(passes, frame, casters, settings).count();
}

} // namespace gnomon::shadow::parts
