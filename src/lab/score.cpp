// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include "metrics/metrics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::lab {

namespace {

/// Pixels on which the hard truth is not the same all over: another value at one of eight points half a pixel away, or at one of
/// eight a fiftieth away, since a shadow thinner than half a pixel can lie on the centre and miss the others.
std::vector<uint8_t> edge_band(const Stage& stage, const scene::Light& light, const truth::Reference& truth)
{
    std::vector<uint8_t> band(truth.primary.primitive.size(), 0);
    constexpr std::array<std::array<float, 2>, 8> around = {{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}, {0, -1}, {0, 1}, {-1, 0}, {1, 0}}};
    const truth::Tracer tracer(stage.scene);
    for (const float distance : {0.5f, 0.02f})
        for (const auto& [dx, dy] : around) {
            const scene::View view = scene::make_view(stage.camera, stage.view.size, stage.bounds, distance * vec2(dx, dy));
            const truth::Visibility shifted = tracer.visibility(view, tracer.primary(view), light, {.samples = 1});
            for (size_t i = 0; i < band.size(); ++i)
                if (shifted.mean.values[i] != truth.visibility.mean.values[i]) band[i] = 1;
        }
    for (size_t i = 0; i < band.size(); ++i) {
        const vec3 p(
            truth.primary.position.values[i * 3], truth.primary.position.values[i * 3 + 1], truth.primary.position.values[i * 3 + 2]);
        const vec3 n(truth.primary.normal.values[i * 3], truth.primary.normal.values[i * 3 + 1], truth.primary.normal.values[i * 3 + 2]);
        const vec4 point = scene::light_point(light, p, vec2(0.5f));
        const vec3 to_light = glm::normalize(point.w == 0.0f ? vec3(point) : vec3(point) - p);
        if (std::abs(glm::dot(n, to_light)) < 1e-3f) band[i] = 1;
    }
    return band;
}

void score_filter(const FilterReference& filter, base::Picture test, const std::vector<uint8_t>& mask, Run& out)
{
    out.reference_refused = filter.refused;
    if (filter.image.empty()) return;
    test = judged_channels(test, filter.image.channels);
    if (filter.image.channels != test.channels) {
        out.reference_refused = fmt::format("{} writes another kind of image than {}", filter.choice, out.technique);
        return;
    }
    const base::Picture no_variance;
    out.metrics.merge(metrics::measure_filter({test, filter.image, no_variance, mask}));
    out.reference = filter.choice;
}

} // namespace

std::vector<uint8_t> score_mask(const truth::Primary& rays, const Rendered& raster, size_t* excluded)
{
    const base::Picture &depth = raster.aovs.at("depth"), &normal = raster.aovs.at("geometric_normal");
    std::vector<uint8_t> mask(raster.primitive.size(), 0);
    for (size_t i = 0; i < mask.size(); ++i) {
        const bool drawn = raster.primitive[i] != truth::no_primitive, hit = rays.primitive[i] != truth::no_primitive;
        if (!drawn && !hit) continue;
        const auto vector = [i](const base::Picture& p) { return vec3(p.values[3 * i], p.values[3 * i + 1], p.values[3 * i + 2]); };
        const bool coincident = drawn && hit && std::abs(depth.values[i] - rays.depth.values[i]) < 1e-4f * rays.depth.values[i]
            && glm::dot(vector(normal), vector(rays.normal)) > 0.99985f;
        mask[i] = drawn && hit && (raster.primitive[i] == rays.primitive[i] || coincident);
        if (excluded) *excluded += !mask[i];
    }
    return mask;
}

Run new_run(const Stage& stage, const Choice& choice, const std::string& light)
{
    Run run;
    run.name = choice_text(choice);
    run.technique = choice.info->id, run.scene = stage.scene_name, run.camera = stage.camera.name, run.light = light;
    run.size = stage.view.size, run.params = choice.params.json().dump();
    return run;
}

void add_times(Run& run, const Rendered& rendered)
{
    run.passes = rendered.passes, run.bytes = rendered.technique_bytes, run.counts = rendered.counts;
    run.technique_ms = rendered.technique_ms, run.technique_deviation = rendered.technique_deviation;
    run.technique_least_ms = rendered.technique_least_ms;
}

truth::Quantity truth_quantity(const Choice& choice)
{
    return output_of(choice) == shadow::Output::transmittance ? truth::Quantity::transmittance : truth::Quantity::visibility;
}

base::Picture judged_channels(const base::Picture& image, int truth_channels)
{
    if (image.channels != 4 && image.channels >= truth_channels) return image;
    base::Picture out(image.size, 3);
    for (size_t i = 0; i < image.size.area(); ++i)
        for (size_t c = 0; c < 3; ++c)
            out.values[i * 3 + c] = image.values[i * size_t(image.channels) + std::min(c, size_t(image.channels) - 1)];
    return out;
}

FilterReference filter_reference(gpu::Device& device, shadow::SceneGpu& scene, const Stage& stage, const std::string& choice)
{
    const Choice parsed = parse_choice(choice);
    FilterReference out{choice, {}, shadow::refusal(*parsed.info, device, stage.lights.front())};
    if (!out.refused.empty()) return out;
    out.image = judged_channels(render(device, scene, stage, parsed, {.lit = false}).images.front(), 1);
    return out;
}

void score(const Stage& stage, const scene::Light& light, const truth::Reference& truth, const Rendered& rendered, Run& out,
    const ScoreOptions& options)
{
    const std::vector<uint8_t> mask = score_mask(truth.primary, rendered, &out.excluded_pixels);
    out.scored_pixels = size_t(std::count(mask.begin(), mask.end(), uint8_t(1)));
    const base::Picture test = judged_channels(rendered.images.front(), truth.visibility.mean.channels);
    const bool hard = !light.soft();
    const metrics::Comparison comparison{test, truth.visibility.mean, truth.visibility.variance, mask, hard};
    out.metrics = metrics::measure(comparison);
    out.truth_samples = truth.visibility.samples;
    out.truth_noise = out.metrics.count("noise") ? out.metrics["noise"] : 0.0;
    if (hard && truth.visibility.mean.channels == 1 && out.scored_pixels > 0) {
        size_t acne = 0, leak = 0;
        if (out.metrics["wrong_pixels"] > 0) {
            std::vector<uint8_t> own;
            std::vector<uint8_t>& band = options.edge_band ? *options.edge_band : own;
            if (band.empty()) band = edge_band(stage, light, truth);
            for (size_t i = 0; i < mask.size(); ++i)
                if (mask[i] && !band[i]) {
                    const float difference = test.values[i] - truth.visibility.mean.values[i];
                    acne += difference<-0.5f, leak += difference> 0.5f;
                }
        }
        out.metrics["wrong_outside_band"] = double(acne + leak) / double(out.scored_pixels);
        out.metrics["acne_outside_band"] = double(acne) / double(out.scored_pixels);
        out.metrics["leak_outside_band"] = double(leak) / double(out.scored_pixels);
    }
    if (options.filter) score_filter(*options.filter, judged_channels(rendered.images.front(), 1), mask, out);
    if (options.heat_map) *options.heat_map = metrics::signed_heat_map(comparison);
}

} // namespace gnomon::lab
