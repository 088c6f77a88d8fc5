// SPDX-License-Identifier: Apache-2.0
// Resolution-matched shadow maps (Lefohn, Sengupta, Owens 2007) in a page cache that outlives the frame.
#include "techniques/virtual_shadow_map/virtual_shadow_map.h"

#include "shadow/light_constants.h"

#include <algorithm>
#include <cmath>

namespace gnomon::techniques::virtual_shadow_map {

namespace {

using namespace shadow;

/// Pairs of pages and clusters that one batch of pages has room for: 8 bytes each.
constexpr uint32_t batch_pairs = 1u << 20;

uint64_t run_count(const Grid& grid) { return (grid.entries + VIRTUAL_RUN - 1) / VIRTUAL_RUN; }

void describe(Params& p, Fields& fields)
{
    fields.choice("virtual_size", p.virtual_size, {"1024", "2048", "4096", "8192", "16384", "32768"},
        "Texels a side of the finest map of a spot or of a point's face; of a directional light, of each level's window around the view.");
    fields.integer("finer_levels", p.finer_levels, {0, 12}, "levels",
        "A directional light's levels beyond the one whose whole map has that size: each has texels half as wide.");
    fields.choice("page", p.page, {"64", "128", "256"}, "Texels a side of a page.");
    fields.integer("pool_pages", p.pool_pages, {16, 2048}, "pages",
        "Pages that have memory; where more are needed, all texels are taken twice, four times, ... as long.");
    fields.real("footprint", p.footprint, {0.01, 64}, "pixels", "Longest side that a texel may have, seen from the eye.");
    fields.real("grazing", p.grazing, {0, 30}, "degrees",
        "Receivers at less than this angle to the light get no finer texels than those at it: they ask for many pages, and are dim.");
    fields.integer("pcf", p.pcf, {1, 15}, "taps", "Percentage-closer filter of n x n comparisons, one texel apart; 1 = none.");
    fields.flag("bilinear", p.bilinear, "Each comparison blends a 2 x 2 block instead of taking the nearest texel.");
    fields.real("bias_constant", p.bias_constant, {0, 1}, "m", "Depth by which a receiver is moved towards the light.");
    fields.real("bias_cone", p.bias_cone, {0, 64}, "",
        "Depth by which a texel may lie before the receiver, metres for each metre between them; 0: the receiver's plane alone.");
    fields.real(
        "slope_limit", p.slope_limit, {0, 1000}, "", "The steepest receiver whose plane the filter follows, metres of depth a metre.");
    fields.flag("cache", p.cache, "Pages are kept from frame to frame; off: all are drawn anew. The picture is the same.");
    fields.choice("show", p.show, {"shadow", "level", "footprint"},
        "To look at instead of the shadow: each pixel's level (black: coarsest), or its texel's longest side (grey: as asked for).");
}

} // namespace

bool VirtualShadowMap::prepare(gpu::PassList& passes, const Frame& frame, const Params& params)
{
    const VkPhysicalDeviceLimits& limits = device_.limits();
    const int pool = int(std::min({uint32_t(params.pool_pages), limits.maxImageArrayLayers, limits.maxFramebufferLayers}));
    const Grid grid = fit_grid(frame.view, frame.resources.bounds(), frame.light, params, pool);
    const bool same_casters = casters_.update(device_, frame.resources);
    const bool keep = params.cache && slots_ && same_casters && same_pages(grid, grid_);
    grid_ = grid;
    ++frame_;
    if (!counts_) counts_ = device_.buffer({sizeof(Counts), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, gpu::Memory::device, "page counts"});
    if (!slots_ || slots_.desc().bytes != uint64_t(pool) * sizeof(Slot))
        slots_ = device_.buffer({uint64_t(pool) * sizeof(Slot), 0, gpu::Memory::device, "page slots"});
    const int drawn = grid.page + 2 * grid.border;
    if (!pool_ || pool_.desc().size.width != drawn || int(pool_.desc().layers) != pool)
        pool_ = device_.image({VK_FORMAT_D32_SFLOAT, {drawn, drawn}, uint32_t(pool), 1, VK_SAMPLE_COUNT_1_BIT, false, "page pool"});
    if (!keep) passes.fill(passes.import(slots_), VIRTUAL_NO_PAGE, "forget pages");
    return keep;
}

gpu::ImageId VirtualShadowMap::request(gpu::PassList& passes, const Frame& frame, const Params& params, const Work& work)
{
    const gpu::ImageId wanted
        = passes.transient({VK_FORMAT_R32_SFLOAT, frame.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "wanted level"});
    passes.fullscreen({.name = "request",
        .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/virtual_shadow_map/virtual_shadow_map_request.frag"),
        .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {work.marks, gpu::Use::update}},
        .constants = RequestConstants{view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()),
            grid_, params.footprint, std::sin(params.grazing * pi / 180.0f)},
        .colors = {{wanted}}});
    return wanted;
}

gpu::ComputePass VirtualShadowMap::compute(const char* name, const Work& work, std::vector<gpu::Binding> bindings, uint64_t threads) const
{
    return {.name = name,
        .program = &device_.compute_program(std::string("techniques/virtual_shadow_map/virtual_shadow_map_") + name + ".comp"),
        .bindings = std::move(bindings),
        .constants = work.constants,
        .threads = {uint32_t(threads), 1, 1}};
}

void VirtualShadowMap::allocate(gpu::PassList& passes, const Work& w)
{
    using gpu::Use;
    const uint64_t runs = run_count(grid_), pool = uint64_t(grid_.pool);
    const gpu::BufferId run_counts = passes.transient(gpu::BufferDesc{runs * 4, 0, gpu::Memory::device, "new pages of runs"});
    const gpu::BufferId fresh = passes.transient(gpu::BufferDesc{pool * 8, 0, gpu::Memory::device, "new pages"});
    const gpu::BufferId chosen = passes.transient(gpu::BufferDesc{pool * 4, 0, gpu::Memory::device, "layers of new pages"});
    const gpu::BufferId moved = passes.import(casters_.moved());
    passes.compute(compute("ancestors", w, {{w.marks, Use::update}, {w.counts, Use::update}}, runs));
    passes.compute(compute("keep", w,
        {{w.marks, Use::load}, {w.counts, Use::update}, {w.slots, Use::update}, {w.table, Use::update}, {moved, Use::load}}, pool));
    passes.compute(
        compute("count", w, {{w.marks, Use::load}, {w.counts, Use::load}, {w.table, Use::load}, {run_counts, Use::store}}, runs));
    passes.compute(compute("list", w,
        {{w.marks, Use::load}, {w.counts, Use::update}, {w.table, Use::load}, {run_counts, Use::load}, {fresh, Use::store}}, runs));
    passes.compute(compute("evict", w, {{w.counts, Use::load}, {w.slots, Use::load}, {chosen, Use::store}}, pool));
    passes.compute(compute("place", w,
        {{w.counts, Use::load}, {fresh, Use::load}, {chosen, Use::load}, {w.slots, Use::update}, {w.table, Use::update},
            {w.pages, Use::store}},
        pool));
}

void VirtualShadowMap::draw_batch(gpu::PassList& passes, const Frame& frame, const Work& w, uint32_t first_page, uint32_t page_count)
{
    using gpu::Use;
    const uint32_t opaque = casters_.opaque(), masked = casters_.masked(), clusters = opaque + masked;
    const gpu::BufferId commands = passes.transient(
        gpu::BufferDesc{4 + uint64_t(clusters) * 20, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, gpu::Memory::device, "draws of clusters"});
    const gpu::BufferId pairs
        = passes.transient(gpu::BufferDesc{uint64_t(clusters) * page_count * 8, 0, gpu::Memory::device, "pages and clusters"});
    passes.fill(commands, 0, "clear draws");
    gpu::ComputePass cull = compute("cull", w,
        {{w.counts, Use::update}, {w.pages, Use::load}, {passes.import(casters_.clusters()), Use::load}, {commands, Use::update},
            {pairs, Use::store}},
        clusters);
    cull.constants = CullConstants{clusters, first_page, page_count};
    passes.compute(std::move(cull));

    SceneGpu& scene = frame.resources;
    const gpu::Program& solid = device_.raster_program("techniques/virtual_shadow_map/virtual_shadow_map_casters.vert", "");
    const gpu::Program& holed = device_.raster_program(
        "techniques/virtual_shadow_map/virtual_shadow_map_masked.vert", "src/shadow/parts/light_depth_masked.frag");
    passes.raster({.name = "draw pages",
        .program = &solid,
        .bindings = {{passes.import(scene.instances()), Use::load}, {passes.import(scene.materials()), Use::load}, {w.pages, Use::load},
            {pairs, Use::load}},
        .constants = DrawConstants{grid_},
        .textures = &scene.textures(),
        .depth = gpu::DepthTarget{.image = passes.import(pool_), .load = gpu::Load::keep},
        .layers = uint32_t(grid_.pool),
        .depth_clamp = grid_.face[0].perspective == 0,
        .streams = {SceneGpu::position_stream(), SceneGpu::attribute_stream()},
        .buffers = {{commands, Use::indirect}},
        .draw = [&scene, &solid, &holed, commands, opaque, masked](gpu::Encoder& encoder) {
            encoder.vertex_buffer(0, scene.positions());
            encoder.vertex_buffer(1, scene.attributes());
            encoder.index_buffer(scene.indices());
            encoder.program(solid);
            if (opaque) encoder.draw_indexed_indirect(commands, 4, opaque, 20);
            if (!masked) return;
            encoder.program(holed);
            encoder.draw_indexed_indirect(commands, 4 + uint64_t(opaque) * 20, masked, 20);
        }});
}

void VirtualShadowMap::draw(gpu::PassList& passes, const Frame& frame, const Work& w)
{
    passes.raster({.name = "clear pages",
        .program = &device_.raster_program("techniques/virtual_shadow_map/virtual_shadow_map_clear.vert", ""),
        .bindings = {{w.pages, gpu::Use::load}},
        .depth = gpu::DepthTarget{.image = passes.import(pool_),
            .load = w.kept ? gpu::Load::keep : gpu::Load::discard,
            .compare = VK_COMPARE_OP_ALWAYS},
        .layers = uint32_t(grid_.pool),
        .buffers = {{w.counts, gpu::Use::indirect}},
        .draw = [counts = w.counts](gpu::Encoder& encoder) { encoder.draw_indirect(counts, 0, 1, 16); }});
    const uint32_t clusters = casters_.opaque() + casters_.masked(), pool = uint32_t(grid_.pool);
    if (clusters == 0) return;
    // room for every page to hold every cluster: what is drawn never depends on what fits
    const uint32_t batch = std::clamp(batch_pairs / clusters, 16u, pool);
    for (uint32_t first = 0; first < pool; first += batch) draw_batch(passes, frame, w, first, std::min(batch, pool - first));
}

void VirtualShadowMap::resolve(gpu::PassList& passes, const Frame& frame, const Params& params, const Work& w, gpu::ImageId wanted)
{
    const auto draw = [&](const char* name, int show, gpu::ImageId target) {
        const gpu::SpecConstant modes[]
            = {{0, uint32_t(params.pcf)}, {1, uint32_t(params.bilinear)}, {2, uint32_t(show)}, {3, uint32_t(params.bias_cone > 0.0f)}};
        passes.fullscreen({.name = name,
            .program
            = &device_.raster_program("shaders/fullscreen.vert", "techniques/virtual_shadow_map/virtual_shadow_map_resolve.frag", modes),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {wanted, gpu::Use::sample},
                gpu::Binding(passes.import(pool_), gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {w.table, gpu::Use::load},
                {w.counts, gpu::Use::load}},
            .constants = ResolveConstants{view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()),
                grid_, params},
            .colors = {{target}}});
    };
    draw("resolve", params.show, frame.output);
    if (!frame.inspections) return;
    for (const auto& [name, show] : {std::pair{"page", VIRTUAL_INSPECT_PAGE}, {"level", VIRTUAL_INSPECT_LEVEL}}) {
        frame.inspections->push_back({name, "", true, inspection_image(passes, frame)});
        draw("inspect pages", show, frame.inspections->back().image);
    }
}

void VirtualShadowMap::record_with(gpu::PassList& passes, const Frame& frame, const Params& params)
{
    const bool kept = prepare(passes, frame, params);
    const gpu::BufferDesc marks{(grid_.entries + run_count(grid_)) * 4, 0, gpu::Memory::device, "page marks"};
    const gpu::BufferDesc entries{uint64_t(grid_.entries) * 4, 0, gpu::Memory::device, "page table"};
    const gpu::BufferDesc pages{uint64_t(grid_.pool) * sizeof(PageDraw), 0, gpu::Memory::device, "pages to draw"};
    const Work w{passes.transient(marks), passes.transient(entries), passes.import(counts_), passes.import(slots_), passes.transient(pages),
        {grid_, frame_, casters_.moved_count()}, kept};
    passes.fill(w.marks, 0, "clear marks");
    passes.fill(w.table, 0, "clear table");
    passes.fill(w.counts, 0, "clear counts");
    const gpu::ImageId wanted = request(passes, frame, params, w);
    allocate(passes, w);
    draw(passes, frame, w);
    resolve(passes, frame, params, w, wanted);
}

} // namespace gnomon::techniques::virtual_shadow_map

extern const gnomon::shadow::TechniqueInfo technique_virtual_shadow_map;
const gnomon::shadow::TechniqueInfo technique_virtual_shadow_map = {
    .id = "virtual_shadow_map",
    .title = "Virtual shadow map",
    .family = "shadow maps",
    .cite = "Fernando, Fernandez, Bala, Greenberg 2001; Lefohn, Sengupta, Owens 2007",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .temporal = true,
    .reads_vertices = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::virtual_shadow_map::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::virtual_shadow_map::VirtualShadowMap>(device);
    },
};
