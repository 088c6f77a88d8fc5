// SPDX-License-Identifier: Apache-2.0
// Hard shadows tested at the view's own samples (Aila, Laine 2004; Johnson et al. 2005), in lists as Sintorn, Eisemann, Assarsson 2008
// make them, and at several positions of a pixel (Pan et al. 2009).
#include "techniques/alias_free/alias_free.shared.h"

#include "base/error.h"
#include "shadow/light_constants.h"
#include "shadow/parts/caster_blocks.h"
#include "shadow/parts/fit.h"
#include "shadow/technique.h"

#include <algorithm>
#include <cmath>

namespace gnomon::techniques::alias_free {

namespace {

using namespace shadow;

constexpr int sample_counts[] = {1, 8, 32};

void describe(Params& p, Fields& fields)
{
    fields.choice("samples", p.samples, {"1", "8", "32"},
        "Positions a pixel at which visibility is decided: its centre, or that many over its footprint on the receiver's plane.");
    fields.integer(
        "grid", p.grid, {16, 1024}, "cells", "Width and height of the grid of lists, each layer; the picture does not depend on it.");
    fields.choice("grid_fit", p.grid_fit, {"uniform", "focused", "cascades"},
        "What the grid of a directional light covers: the whole scene, what the view sees of it, or that in four layers one behind "
        "another.");
}

/// Footprints of any extent find a level, the last of which is one cell; points need one.
Grid make_grid(int side, bool footprints)
{
    Grid grid{};
    float scale = float(side);
    vec2 corner(0);
    grid.image = vec2(float(side));
    for (uint32_t i = 0; i < GRID_MAX_LEVELS; ++i, scale *= 0.5f) {
        const auto cells = uint32_t(std::ceil(scale));
        grid.level[i] = {.side = cells, .first = grid.cells, .scale = scale, .corner = corner};
        grid.cells += cells * cells, ++grid.levels;
        grid.image = glm::max(grid.image, corner + vec2(float(cells)));
        corner = i == 0 ? vec2(float(side), 0) : corner + vec2(0, float(cells)); // the first; the others beside it, in a column
        if (!footprints || cells == 1) break;
    }
    return grid;
}

/// Room for triangles that cover many cells, over all layers and levels. What does not fit takes the slower way.
constexpr uint32_t wide_casters = 1u << 18;

gpu::Threads folded(uint64_t threads, uint32_t group, uint32_t z)
{
    const uint64_t row = uint64_t(group) << 15; // half of the groups that every device can run along an axis
    return {uint32_t(std::min(threads, row)), uint32_t((threads + row - 1) / row), z};
}

struct Lists {
    GridConstants constants;
    std::vector<gpu::SpecConstant> samples;
    gpu::ImageId places;
    gpu::BufferId cells, records, blocked, wide, draw;
};

class AliasFree final : public TechniqueWith<Params> {
public:
    explicit AliasFree(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const Lists lists = list_samples(passes, frame, params);
        test_casters(passes, frame, lists, draw_reach(passes, lists));
        passes.fullscreen({.name = "resolve",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/alias_free/alias_free_resolve.frag", lists.samples),
            .bindings = {{lists.places, gpu::Use::sample}, {lists.cells, gpu::Use::load}, {lists.blocked, gpu::Use::load}},
            .colors = {{frame.output}}});
    }

    static uint64_t bytes_of(const GridConstants& c) { return 4 * (GRID_HEADER + 4 * uint64_t(c.grid.cells) * c.map.layer_count); }

    /// The grid that was asked for, or as large a one as a buffer takes: the picture is the same.
    void place_grid(GridConstants& c, const Frame& frame, const Params& params, uint64_t limit) const
    {
        const Bounds& bounds = frame.resources.bounds();
        c.view = view_constants(frame.view, frame.index), c.light = light_constants(frame.light, bounds);
        c.blocks = block_count_, c.wide = wide_casters;
        for (int side = params.grid;; side -= side / 8) {
            c.map = parts::fit_light_map(frame.scene, bounds, frame.view, frame.light, {.size = side, .fitting = {.fit = params.grid_fit}});
            c.grid = make_grid(side, sample_counts[params.samples] > 1);
            if (bytes_of(c) <= limit) return;
        }
    }

    Lists list_samples(gpu::PassList& passes, const Frame& frame, const Params& params)
    {
        Lists lists;
        const int samples = sample_counts[params.samples];
        if (!blocks_) read_casters(frame.resources);
        lists.samples = {{0, uint32_t(samples)}};
        const uint64_t pixels = frame.view.size.area(), record = samples > 1 ? 48 : 16, limit = device_.limits().maxStorageBufferRange;
        if (pixels * record > limit)
            base::fail("alias_free lists {} bytes a pixel at {} samples, more than a buffer of {} bytes takes for {}x{} pixels; choose a "
                       "smaller --size or samples=1",
                record, samples, limit, frame.view.size.width, frame.view.size.height);
        place_grid(lists.constants, frame, params, limit);
        const uint32_t cells = lists.constants.grid.cells * lists.constants.map.layer_count;
        const gpu::Size size = frame.view.size;
        lists.places = passes.transient(gpu::ImageDesc{VK_FORMAT_R32G32_UINT, size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "places"});
        lists.cells = passes.transient(gpu::BufferDesc{bytes_of(lists.constants), 0, gpu::Memory::device, "cells"});
        lists.records = passes.transient(gpu::BufferDesc{pixels * record, 0, gpu::Memory::device, "records"});
        lists.blocked = passes.transient(gpu::BufferDesc{pixels * 4, 0, gpu::Memory::device, "blocked"});
        lists.wide = passes.transient(gpu::BufferDesc{wide_casters * sizeof(WideCaster), 0, gpu::Memory::device, "wide casters"});
        lists.draw = passes.transient(
            gpu::BufferDesc{sizeof(VkDrawIndirectCommand), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, gpu::Memory::device, "draw"});
        passes.fill(lists.cells, 0, "empty lists");
        passes.fullscreen({.name = "project",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/alias_free/alias_free_project.frag", lists.samples),
            .bindings
            = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {lists.cells, gpu::Use::update}},
            .constants = lists.constants,
            .colors = {{lists.places, gpu::Load::discard}}});
        passes.compute({.name = "allocate",
            .program = &device_.compute_program("techniques/alias_free/alias_free_allocate.comp"),
            .bindings = {{lists.cells, gpu::Use::update}, {lists.draw, gpu::Use::store}},
            .constants = cells,
            .threads = folded(cells, 64, 1)});
        gpu::RasterPass list{.name = "list",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/alias_free/alias_free_list.frag", lists.samples),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                {frame.gbuffer.primitive, gpu::Use::sample}, {lists.places, gpu::Use::sample}, {lists.cells, gpu::Use::load},
                {lists.records, gpu::Use::store}, {lists.blocked, gpu::Use::store}},
            .constants = lists.constants,
            .size = size};
        list.draw = [](gpu::Encoder& encoder) { encoder.draw(3); };
        passes.raster(std::move(list));
        return lists;
    }

    /// An image of cells, each level in its place: the depth that a caster has to be in front of.
    gpu::ImageId draw_reach(gpu::PassList& passes, const Lists& lists) const
    {
        const uint32_t layers = lists.constants.map.layer_count;
        const gpu::Size size{int(lists.constants.grid.image.x), int(lists.constants.grid.image.y)};
        gpu::RasterPass pass{.name = "reach",
            .program = &device_.raster_program("shaders/fullscreen_layers.vert", "techniques/alias_free/alias_free_reach.frag"),
            .bindings = {{lists.cells, gpu::Use::load}},
            .constants = lists.constants.grid,
            .layers = layers};
        pass.depth = gpu::DepthTarget{
            .image = passes.transient(gpu::ImageDesc{VK_FORMAT_D32_SFLOAT, size, layers, 1, VK_SAMPLE_COUNT_1_BIT, false, "reach"}),
            .load = gpu::Load::discard,
            .compare = VK_COMPARE_OP_ALWAYS};
        const gpu::ImageId reach = pass.depth->image;
        pass.draw = [layers](gpu::Encoder& encoder) { encoder.draw(3, layers); };
        passes.raster(std::move(pass));
        return reach;
    }

    /// Those of few cells in a compute pass, the others by the rasteriser.
    void test_casters(gpu::PassList& passes, const Frame& frame, const Lists& lists, gpu::ImageId reach)
    {
        SceneGpu& scene = frame.resources;
        const std::vector<gpu::Binding> shared = {{lists.cells, gpu::Use::update}, {lists.records, gpu::Use::load},
            {lists.blocked, gpu::Use::update}, {passes.import(scene.instances()), gpu::Use::load},
            {passes.import(scene.indices()), gpu::Use::load}, {passes.import(scene.positions()), gpu::Use::load},
            {passes.import(scene.materials()), gpu::Use::load}, {passes.import(scene.attributes()), gpu::Use::load}};
        const uint32_t layers = lists.constants.map.layer_count;
        gpu::ComputePass narrow{.name = "narrow casters",
            .program = &device_.compute_program("techniques/alias_free/alias_free_narrow.comp", lists.samples),
            .bindings = shared,
            .constants = lists.constants,
            .threads = folded(uint64_t(block_count_) * CASTER_BLOCK, CASTER_BLOCK, layers),
            .textures = &scene.textures()};
        narrow.bindings.insert(narrow.bindings.end(),
            {{lists.wide, gpu::Use::store}, {lists.draw, gpu::Use::update}, {passes.import(blocks_), gpu::Use::load}});
        passes.compute(std::move(narrow));

        gpu::RasterPass wide{.name = "wide casters",
            .program = &device_.raster_program(
                "techniques/alias_free/alias_free_wide.vert", "techniques/alias_free/alias_free_wide.frag", lists.samples),
            .bindings = shared,
            .constants = lists.constants,
            .textures = &scene.textures(),
            .depth = gpu::DepthTarget{.image = reach,
                .load = gpu::Load::keep,
                .write = false,
                .store = false,
                .compare = VK_COMPARE_OP_GREATER_OR_EQUAL},
            .layers = layers,
            .buffers = {{lists.draw, gpu::Use::indirect}}};
        wide.bindings.push_back({lists.wide, gpu::Use::load});
        wide.draw = [draw = lists.draw](gpu::Encoder& encoder) { encoder.draw_indirect(draw, 0, 1, sizeof(VkDrawIndirectCommand)); };
        passes.raster(std::move(wide));
    }

    void read_casters(SceneGpu& scene)
    {
        const std::vector<CasterBlock> blocks = parts::caster_blocks(scene);
        block_count_ = uint32_t(blocks.size());
        blocks_ = device_.buffer({std::max<uint64_t>(blocks.size(), 1) * sizeof(CasterBlock), 0, gpu::Memory::device, "caster blocks"});
        if (!blocks.empty()) device_.upload(blocks_, std::as_bytes(std::span(blocks)));
    }

    uint64_t kept_bytes() const override { return blocks_ ? blocks_.desc().bytes : 0; }

    gpu::Buffer blocks_; ///< of the scene's triangles, made on first use
    uint32_t block_count_ = 0;
    gpu::Device& device_;
};

} // namespace

} // namespace gnomon::techniques::alias_free

extern const gnomon::shadow::TechniqueInfo technique_alias_free;
const gnomon::shadow::TechniqueInfo technique_alias_free = {
    .id = "alias_free",
    .title = "Alias-free shadow map",
    .family = "hard shadows",
    .cite = "Aila, Laine 2004; Johnson et al. 2005; Sintorn, Eisemann, Assarsson 2008",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .exact = true,
    .reads_ids = [](std::span<const std::byte>) { return true; },
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::alias_free::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::alias_free::AliasFree>(device);
    },
};
