// SPDX-License-Identifier: Apache-2.0
// Hard shadows by the volume behind each triangle, taken down a tree over the view's depths (Sintorn, Olsson, Assarsson 2011).
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"

#include "shadow/light_constants.h"
#include "shadow/parts/caster_blocks.h"
#include "shadow/technique.h"
#include "techniques/per_triangle_volumes/depth_tree.h"
#include "techniques/per_triangle_volumes/modes.h"

#include <algorithm>

namespace gnomon::techniques::per_triangle_volumes {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    fields.choice("cull", p.cull, {"none", "front", "back"},
        "Triangles of single-sided materials that are left out: those that face the light, or those that do not. Exact where their meshes "
        "are closed.");
    fields.choice("team", p.team, {"ballot", "shared"},
        "How the invocations that walk the tree together exchange bits: by ballots of a subgroup, or through shared memory.");
    fields.integer("queue", p.queue, {0, 1 << 22}, "entries",
        "Room in the list of nodes between the two passes down the tree; what finds none is finished by the first. The picture does not "
        "depend on it.");
    fields.flag("blockers", p.blockers, "Cast large triangles first and make the tree anew without what they darken.");
    fields.real("blocker_size", p.blocker_size, {0, 1}, "",
        "How large a triangle is, as the light sees it, to be one of those: its area over its squared distance, or over the scene's "
        "squared radius for parallel light, twice.");
    describe_modes(p, fields);
}

/// Casters that are made into volumes at once: the memory that these take does not grow with the scene.
constexpr uint32_t round_blocks = 2048;

/// Homogeneous world positions relative to the eye, by normalised device coordinates.
mat4 world_from_ndc(const scene::View& view)
{
    const glm::dmat4 inverse = glm::inverse(glm::dmat4(view.clip_from_world));
    return mat4(glm::translate(glm::dmat4(1), -glm::dvec3(view.eye)) * inverse);
}

class PerTriangleVolumes final : public TechniqueWith<Params> {
public:
    explicit PerTriangleVolumes(gpu::Device& device)
        : device_(device)
    {
    }

private:
    using Buffers = TreeBuffers;

    void record_with(gpu::PassList& passes, const Frame& drawn, const Params& params) override
    {
        const scene::View view = finer_view(drawn.view, params);
        const Frame frame{drawn.scene, view, drawn.light, drawn.resources, finer_surfaces(passes, drawn, view, params), drawn.output,
            drawn.index, nullptr, drawn.counters};
        if (content_ != frame.resources.content()) read_casters(frame.resources);
        const Tree tree = make_tree(frame.view, uvec2(1) << (params.samples == SAMPLES_EXTRAPOLATED ? samples_log2(params) : uvec2(0)));
        const uint32_t room = 2 * CASTER_BLOCK * std::min(round_blocks, std::max(block_count_, 1u));
        Buffers b = make_buffers(passes, frame, tree, room, uint32_t(params.queue));
        build_tree(passes, frame, tree, b);
        VolumeConstants c = volume_constants(frame, tree, params);
        const auto cast_all = [&](uint32_t first, uint32_t end, bool clear) {
            for (c.first_block = first; c.first_block < end; c.first_block += round_blocks) {
                c.blocks = std::min(round_blocks, end - c.first_block);
                cast(passes, frame, c, params, b, clear);
            }
        };
        const uint32_t solid = params.mode == MODE_BINARY ? opaque_end_ : solid_end_;
        if (params.blockers) {
            c.which = WHICH_LARGE;
            cast_all(0, solid, false);
            rebuild_tree(passes, frame, tree, b);
            c.which = WHICH_OTHERS;
        }
        cast_all(0, solid, false);
        c.which = WHICH_ALL;
        if (params.mode != MODE_BINARY) {
            c.cull = CULL_NONE; // a closed body of glass takes light away at either side
            if (solid_end_ < block_count_) make_sums(passes, tree, params, b);
            cast_all(solid_end_, block_count_, true);
        }
        if (params.mode != MODE_BINARY || params.samples != SAMPLES_ONE) {
            resolve_samples(passes, frame, tree, params, b);
            return;
        }
        passes.fullscreen({.name = "resolve",
            .program
            = &device_.raster_program("shaders/fullscreen.vert", "techniques/per_triangle_volumes/per_triangle_volumes_resolve.frag"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {b.words, gpu::Use::load}},
            .constants = tree,
            .colors = {{frame.output}}});
    }

    const gpu::Program& program(const char* name, bool counting = false) const
    {
        const gpu::SpecConstant constants[] = {{1, 1}};
        return device_.compute_program(
            std::string("techniques/per_triangle_volumes/per_triangle_volumes_") + name + ".comp", std::span(constants, counting ? 1 : 0));
    }

    static VolumeConstants volume_constants(const Frame& frame, const Tree& tree, const Params& params)
    {
        VolumeConstants c{};
        c.light = light_constants(frame.light, frame.resources.bounds());
        c.tree = tree;
        c.world_from_ndc = world_from_ndc(frame.view);
        c.eye = frame.view.eye;
        c.cull = uint32_t(params.cull);
        const float radius = frame.resources.bounds().radius();
        c.large = params.blocker_size * (c.light.kind == LIGHT_DIRECTIONAL ? radius * radius : 1.0f);
        const View view = view_constants(frame.view, frame.index);
        c.eye_point = frame.view.orthographic ? vec4(view.forward, 0) : vec4(0, 0, 0, 1);
        const mat4& m = c.world_from_ndc;
        c.ray = glm::length(vec3(m[0])) + glm::length(vec3(m[1])) + glm::length(vec3(m[3]));
        return c;
    }

    void build_tree(gpu::PassList& passes, const Frame& frame, const Tree& tree, const Buffers& b) const
    {
        passes.compute({.name = "base",
            .program = &program("base"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {b.words, gpu::Use::store},
                {b.tiles, gpu::Use::store}},
            .constants
            = TreeConstants{view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()), tree},
            .threads = {tree.first[2]}});
        reduce_tree(passes, tree, b);
    }

    /// Without the samples that are dark by now.
    void rebuild_tree(gpu::PassList& passes, const Frame& frame, const Tree& tree, const Buffers& b) const
    {
        passes.compute({.name = "rebuild",
            .program = &program("rebuild"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {b.words, gpu::Use::update}, {b.tiles, gpu::Use::store}},
            .constants = tree,
            .threads = {tree.first[2]}});
        reduce_tree(passes, tree, b);
    }

    void reduce_tree(gpu::PassList& passes, const Tree& tree, const Buffers& b) const
    {
        struct Reduce {
            Tree tree;
            uint height;
        };
        for (uint32_t height = 2; height <= tree.height; ++height)
            passes.compute({.name = "reduce",
                .program = &program("reduce"),
                .bindings = {{b.words, gpu::Use::update}, {b.tiles, gpu::Use::update}},
                .constants = Reduce{tree, height},
                .threads = {(height == tree.height ? tree.nodes : tree.first[height + 1]) - tree.first[height]}});
    }

    /// The triangles of a round.
    void cast(gpu::PassList& passes, const Frame& frame, const VolumeConstants& c, const Params& params, const Buffers& b, bool clear)
    {
        SceneGpu& scene = frame.resources;
        passes.fill(b.work, 0, "no work");
        passes.compute({.name = "cull",
            .program = &program("cull", frame.counters),
            .bindings = {{b.words, gpu::Use::load}, {b.tiles, gpu::Use::load}, {passes.import(blocks_), gpu::Use::load},
                {passes.import(boxes_), gpu::Use::load}, {b.work, gpu::Use::update}, {b.kept, gpu::Use::store}, counting(frame, b)},
            .constants = c,
            .threads = {c.blocks}});
        find_groups(passes, b, WorkNumber::blocks, ~0u, true);
        passes.compute({.name = "setup",
            .program = &program("setup", frame.counters),
            .bindings = {{b.words, gpu::Use::load}, {b.tiles, gpu::Use::load}, {passes.import(scene.instances()), gpu::Use::load},
                {passes.import(scene.indices()), gpu::Use::load}, {passes.import(scene.positions()), gpu::Use::load},
                {passes.import(scene.materials()), gpu::Use::load}, {passes.import(blocks_), gpu::Use::load}, {b.volumes, gpu::Use::store},
                {b.work, gpu::Use::update}, {b.kept, gpu::Use::load}, counting(frame, b)},
            .constants = c,
            .indirect = b.groups});
        if (clear) {
            traverse_clear(passes, frame, c.tree, params, b);
            return;
        }
        const bool shared = params.team == 1;
        traverse(passes, frame, b,
            {.shader = shared ? "traverse_shared" : "traverse", .specialised = {}, .constants = c.tree, .teams_are_groups = shared});
    }

    void read_casters(SceneGpu& scene)
    {
        const auto [blocks, solid, opaque] = caster_ranges(scene);
        solid_end_ = solid, opaque_end_ = opaque;
        block_count_ = uint32_t(blocks.size());
        blocks_ = device_.buffer({std::max<uint64_t>(blocks.size(), 1) * sizeof(CasterBlock), 0, gpu::Memory::device, "caster blocks"});
        boxes_ = device_.buffer({std::max<uint64_t>(blocks.size(), 1) * sizeof(CasterBox), 0, gpu::Memory::device, "caster boxes"});
        content_ = scene.content();
        if (blocks.empty()) return;
        device_.upload(blocks_, std::as_bytes(std::span(blocks)));
        const std::vector<CasterBox> boxes = parts::caster_boxes(scene, blocks);
        device_.upload(boxes_, std::as_bytes(std::span(boxes)));
    }

    uint64_t kept_bytes() const override { return blocks_ ? blocks_.desc().bytes + boxes_.desc().bytes : 0; }

    gpu::Buffer blocks_, boxes_; ///< of the casters in content_
    std::shared_ptr<const void> content_;
    uint32_t block_count_ = 0, solid_end_ = 0, opaque_end_ = 0; ///< CasterRanges
    gpu::Device& device_;
};

} // namespace

} // namespace gnomon::techniques::per_triangle_volumes

extern const gnomon::shadow::TechniqueInfo technique_per_triangle_volumes;
const gnomon::shadow::TechniqueInfo technique_per_triangle_volumes = {
    .id = "per_triangle_volumes",
    .title = "Per-triangle shadow volumes",
    .family = "hard shadows",
    .cite = "Sintorn, Olsson, Assarsson 2011",
    .output = gnomon::shadow::Output::visibility,
    .output_of = gnomon::techniques::per_triangle_volumes::output_of,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .exact = true,
    .counts = true,
    .reads_vertices = true,
    .reads_ids = [](std::span<const std::byte>) { return true; },
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::per_triangle_volumes::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::per_triangle_volumes::PerTriangleVolumes>(device);
    },
};
