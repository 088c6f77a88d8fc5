// SPDX-License-Identifier: Apache-2.0
#include "techniques/per_triangle_volumes/modes.h"

#include "base/error.h"
#include "shadow/light_constants.h"
#include "shadow/parts/caster_blocks.h"

#include <algorithm>
#include <cstring>

namespace gnomon::techniques::per_triangle_volumes {

using namespace shadow;

void describe_modes(Params& p, Fields& fields)
{
    fields.choice("mode", p.mode, {"binary", "alpha", "rgb", "textured", "stochastic"},
        "What semitransparent triangles do: nothing; take away one share of grey each; of each colour; what their texture has at every "
        "sample; or all of it at random samples.");
    fields.choice("texture_level", p.texture_level, {"footprint", "finest"},
        "Level of detail of textures: that of a pixel's width at the receiver, as the light throws it on the caster, or always the "
        "finest.");
    fields.choice("samples", p.samples, {"1", "4", "16", "extrapolated"},
        "Samples of each pixel, of which the mean is taken: up to 16, every one with a depth of its own, or 32 on the plane of the "
        "triangle "
        "that the pixel shows.");
}

Output output_of(std::span<const std::byte> bytes)
{
    Params params{};
    std::memcpy(&params, bytes.data(), sizeof(Params));
    return params.mode == MODE_BINARY ? Output::visibility : Output::transmittance;
}

CasterRanges caster_ranges(const SceneGpu& scene)
{
    CasterRanges out;
    const std::vector<SceneGpu::Drawable> drawables = scene.drawables();
    std::vector<uint8_t> glass(scene.slot_count(), 0);
    for (const SceneGpu::Drawable& d : drawables)
        glass[d.slot] = scene.scene().materials[size_t(scene.scene().meshes[d.mesh].material)].transmission > 0.0f;
    out.blocks = parts::caster_blocks(scene);
    const auto end = std::stable_partition(out.blocks.begin(), out.blocks.end(), [&](const CasterBlock& b) { return glass[b.slot] == 0; });
    out.solid = uint32_t(end - out.blocks.begin());
    out.opaque = uint32_t(out.blocks.size());
    for (const SceneGpu::Drawable& d : drawables)
        for (uint32_t first = 0; d.set == draw_blended && first < d.index_count / 3; first += CASTER_BLOCK)
            out.blocks.push_back({d.slot, first, std::min(uint32_t(CASTER_BLOCK), d.index_count / 3 - first), 0});
    return out;
}

namespace {

uint32_t channels(const Params& p) { return p.mode == MODE_ALPHA ? 1 : p.mode == MODE_RGB || p.mode == MODE_TEXTURED ? 3 : 0; }

/// Those without sums are given `other`, which they do not look at.
gpu::BufferId sums_or(const TreeBuffers& b, uint32_t channel, gpu::BufferId other) { return b.sums[channel] ? b.sums[channel] : other; }

} // namespace

scene::View finer_view(scene::View view, const Params& p)
{
    const int side = p.samples == SAMPLES_EXTRAPOLATED ? 1 : 1 << p.samples;
    view.size = {view.size.width * side, view.size.height * side};
    return view;
}

uvec2 samples_log2(const Params& p) { return p.samples == SAMPLES_EXTRAPOLATED ? uvec2(3, 2) : uvec2(uint(p.samples)); }

GBuffer finer_surfaces(gpu::PassList& passes, const Frame& frame, const scene::View& finer, const Params& p)
{
    if (p.samples == SAMPLES_ONE) return frame.gbuffer;
    if (p.samples != SAMPLES_EXTRAPOLATED) return draw_gbuffer(passes, frame.resources, finer, {.material = false});
    GBuffer g = frame.gbuffer;
    g.depth = passes.transient(gpu::ImageDesc{VK_FORMAT_R32G32B32A32_SFLOAT, finer.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "slopes"});
    passes.fullscreen({.name = "slopes",
        .program
        = &passes.device().raster_program("shaders/fullscreen.vert", "techniques/per_triangle_volumes/per_triangle_volumes_slopes.frag"),
        .bindings
        = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {frame.gbuffer.primitive, gpu::Use::sample}},
        .constants = view_constants(finer, frame.index),
        .colors = {{g.depth}}});
    return g;
}

void make_sums(gpu::PassList& passes, const Tree& tree, const Params& params, TreeBuffers& b)
{
    const uint64_t bytes = uint64_t(tree.nodes) * 32 * 4, room = passes.device().limits().maxStorageBufferRange;
    if (channels(params) > 0 && bytes > room)
        base::fail("per_triangle_volumes: the sums of {} x {} samples take {} bytes, and this device binds {}; choose a smaller --size or "
                   "fewer samples",
            tree.samples.x, tree.samples.y, bytes, room);
    for (uint32_t k = 0; k < channels(params); ++k) {
        b.sums[k] = passes.transient(gpu::BufferDesc{bytes, 0, gpu::Memory::device, "sums"});
        passes.fill(b.sums[k], 0, "no sums");
    }
}

void traverse_clear(gpu::PassList& passes, const Frame& frame, const Tree& tree, const Params& params, const TreeBuffers& b)
{
    gpu::BufferId none = b.sums[0];
    if (!none) passes.fill(none = passes.transient(gpu::BufferDesc{16, 0, gpu::Memory::device, "no sums"}), 0, "no sums");
    traverse(passes, frame, b,
        {.shader = "clear",
            .specialised = {{2, uint32_t(params.mode)}},
            .constants = ClearConstants{tree, frame.index, uint(params.texture_level), samples_log2(params)},
            .bindings = {{none, gpu::Use::update}, {sums_or(b, 1, none), gpu::Use::update}, {sums_or(b, 2, none), gpu::Use::update}}});
}

void resolve_samples(gpu::PassList& passes, const Frame& frame, const Tree& tree, const Params& params, const TreeBuffers& b)
{
    struct Constants {
        Tree tree;
        uvec2 per_pixel;
    };
    const std::array<gpu::SpecConstant, 1> count{{{0, b.sums[0] ? channels(params) : 0}}};
    passes.fullscreen({.name = "resolve",
        .program = &passes.device().raster_program(
            "shaders/fullscreen.vert", "techniques/per_triangle_volumes/per_triangle_volumes_resolve_samples.frag", count),
        .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {b.words, gpu::Use::load}, {sums_or(b, 0, b.words), gpu::Use::load},
            {sums_or(b, 1, b.words), gpu::Use::load}, {sums_or(b, 2, b.words), gpu::Use::load}},
        .constants = Constants{tree, uvec2(1) << samples_log2(params)},
        .colors = {{frame.output}}});
}

} // namespace gnomon::techniques::per_triangle_volumes
