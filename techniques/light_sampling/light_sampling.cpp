// SPDX-License-Identifier: Apache-2.0
// A light with an area as many lights without: the average of their hard shadows (Brotman and Badler 1984; Haeberli and Akeley 1990).
#include "techniques/light_sampling/light_sampling.shared.h"

#include "base/error.h"
#include "shadow/light_constants.h"
#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"
#include "shadow/technique.h"
#include "techniques/light_sampling/light_points.h"

#include <algorithm>
#include <cmath>

namespace gnomon::techniques::light_sampling {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    fields.integer("samples", p.samples, {1, 1024}, "points", "Points of the light whose hard shadows are averaged; 1 is its centre.");
    fields.choice("by", p.by, {"maps", "rays"}, "Hard shadows by a shadow map from each point, or by rays to the same points.");
    fields.choice(
        "pattern", p.pattern, {"jittered", "hammersley"}, "How the points lie: one at random in each cell of equal area, or evenly.");
    fields.integer("map_size", p.map_size, {16, 4096}, "texels", "maps: width and height of each depth layer.");
    fields.choice("fit", p.fit, {"uniform", "focused"}, "maps: what they cover, the whole scene or the part of it that the view sees.");
    fields.flag("bilinear", p.bilinear, "maps: each comparison blends a 2 x 2 block instead of taking the nearest texel.");
    fields.real("bias", p.bias, {0, 16}, "texels",
        "maps: a receiver is moved towards the light by the depth that its plane gains over so many texels.");
    fields.integer("batch", p.batch, {1, LIGHT_MAP_MAX_LAYERS}, "layers", "maps: layers drawn in one pass and held at once.");
}

/// Planes beyond which the light does not reach: a spot's cone as a pyramid, the back of a rectangle or disk.
Planes reach(const scene::Light& light)
{
    const auto through = [](vec3 n, vec3 p) { return vec4(n, -glm::dot(n, p)); };
    if (const auto* rect = std::get_if<scene::RectLight>(&light.shape))
        return {through(glm::normalize(glm::cross(rect->half_u, rect->half_v)), rect->centre)};
    if (const auto* disk = std::get_if<scene::DiskLight>(&light.shape)) return {through(disk->normal, disk->centre)};
    const auto* spot = std::get_if<scene::SpotLight>(&light.shape);
    if (!spot || spot->outer_angle >= 0.5f * pi) return {};
    const mat3 basis = scene::basis_about(spot->direction);
    const float s = std::sin(spot->outer_angle), c = std::cos(spot->outer_angle);
    Planes sides;
    for (const vec3 across : {basis[0], -basis[0], basis[1], -basis[1]})
        sides.push_back(through(s * spot->direction + c * across, spot->position));
    return sides;
}

/// Vertices of a convex hull of all points whose shadow is asked for.
std::vector<vec3> receivers(const Frame& frame, const Bounds& bounds, bool of_view)
{
    Planes planes = reach(frame.light);
    if (of_view) {
        const Planes view = frustum_planes(frame.view.clip_from_world);
        planes.insert(planes.end(), view.begin(), view.end());
    }
    std::vector<vec3> points = parts::vertices_within(planes, bounds);
    return points.empty() ? parts::corners(bounds) : points;
}

struct Layers {
    std::vector<shaders::LightMapLayer> layers;
    std::vector<LayerSample> samples; ///< one for each
};

class LightSampling final : public TechniqueWith<Params> {
public:
    explicit LightSampling(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const LightPoints points = light_points(frame.light, params.samples, Pattern(params.pattern), frame.resources.bounds().centre());
        if (params.by == LIGHT_SAMPLING_RAYS)
            trace(passes, frame, points);
        else
            draw(passes, frame, params, points);
    }

    Layers fit(const Frame& frame, const Params& params, const LightPoints& points) const;
    void draw(gpu::PassList&, const Frame&, const Params&, const LightPoints& points);
    void trace(gpu::PassList&, const Frame&, const LightPoints& points);

    gpu::Device& device_;
    gpu::Buffer points_;
    std::vector<vec4> uploaded_; ///< what points_ holds
};

parts::LightMapSettings map_settings(const Params& params) { return {.size = params.map_size, .guard_texels = 2.0f}; }

Layers LightSampling::fit(const Frame& frame, const Params& params, const LightPoints& points) const
{
    const Bounds& bounds = frame.resources.bounds();
    const std::vector<vec3> casters = parts::corners(bounds), seen = receivers(frame, bounds, params.fit != 0);
    Layers out;
    for (size_t i = 0; i < points.points.size(); ++i) {
        const vec4 point = points.points[i];
        const vec3 weight(points.weights[i]);
        if (point.w == 0.0f) {
            out.layers.push_back(parts::fit_parallel_layer(-vec3(point), seen, casters, map_settings(params)));
            out.samples.push_back({point, weight, -1});
            continue;
        }
        const parts::PointFit fit = parts::fit_point_layers(vec3(point), seen, bounds, map_settings(params));
        out.layers.insert(out.layers.end(), fit.layers.begin(), fit.layers.end());
        for (const int face : fit.faces) out.samples.push_back({point, weight, face});
    }
    return out;
}

/// The sum goes from one image to the other, since a pass cannot read what it writes. Blending into one image would add each batch's sum
/// and round otherwise for every size of batch.
void LightSampling::draw(gpu::PassList& passes, const Frame& frame, const Params& params, const LightPoints& points)
{
    const Layers all = fit(frame, params, points);
    const size_t total = all.layers.size(), held = std::min(size_t(params.batch), total);
    const gpu::ImageId depth = passes.transient({VK_FORMAT_D32_SFLOAT, {params.map_size, params.map_size}, uint32_t(held), 1,
        VK_SAMPLE_COUNT_1_BIT, false, "maps of light points"});
    const gpu::ImageDesc sum{passes.desc(frame.output).format, frame.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "sum"};
    gpu::ImageId from = passes.transient(sum), to = total > held ? passes.transient(sum) : frame.output;
    passes.clear(from, {});
    const gpu::SpecConstant spec[] = {{0, uint32_t(params.bilinear)}};
    for (size_t first = 0; first < total; first += held) {
        const size_t count = std::min(held, total - first);
        const bool last = first + count == total;
        AddConstants c{view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()), {}, {}, params,
            uint32_t(points.points.size()), last ? 1u : 0u};
        c.map.size = float(params.map_size), c.map.layer_count = uint32_t(count);
        std::copy_n(all.layers.begin() + ptrdiff_t(first), count, c.map.layers);
        std::copy_n(all.samples.begin() + ptrdiff_t(first), count, c.samples);
        parts::draw_light_layers(passes, frame, c.map, map_settings(params), depth);
        passes.fullscreen({.name = "add",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/light_sampling/light_sampling_add.frag", spec),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                gpu::Binding(depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {from, gpu::Use::sample}},
            .constants = c,
            .colors = {{last ? frame.output : to}}});
        std::swap(from, to);
    }
}

void LightSampling::trace(gpu::PassList& passes, const Frame& frame, const LightPoints& points)
{
    if (!device_.info().ray_query)
        base::fail("light_sampling traces rays by ray queries, which this device does not have; set by=maps, or take ray_traced");
    std::vector<vec4> content = points.points;
    content.insert(content.end(), points.weights.begin(), points.weights.end());
    if (content != uploaded_) {
        points_ = device_.buffer({content.size() * sizeof(vec4), 0, gpu::Memory::device, "light points"});
        device_.upload(points_, std::as_bytes(std::span(content)));
        uploaded_ = std::move(content);
    }
    SceneGpu& scene = frame.resources;
    passes.compute({.name = "rays",
        .program = &device_.compute_program("techniques/light_sampling/light_sampling_rays.comp"),
        .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {frame.output, gpu::Use::store},
            scene.tlas(), {passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load},
            {passes.import(scene.indices()), gpu::Use::load}, {passes.import(scene.attributes()), gpu::Use::load},
            {passes.import(points_), gpu::Use::load}},
        .constants = RayConstants{view_constants(frame.view, frame.index), light_constants(frame.light, scene.bounds()),
            uint32_t(points.points.size())},
        .threads = {uint32_t(frame.view.size.width), uint32_t(frame.view.size.height), 1},
        .textures = &scene.textures()});
}

} // namespace

} // namespace gnomon::techniques::light_sampling

extern const gnomon::shadow::TechniqueInfo technique_light_sampling;
const gnomon::shadow::TechniqueInfo technique_light_sampling = {
    .id = "light_sampling",
    .title = "Light sampling",
    .family = "soft shadows",
    .cite = "Brotman, Badler 1984; Haeberli, Akeley 1990; Heckbert, Herf 1997",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::all_lights,
    .soft = true,
    .textured = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::light_sampling::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::light_sampling::LightSampling>(device);
    },
};
