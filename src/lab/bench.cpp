// SPDX-License-Identifier: Apache-2.0
#include "lab/bench.h"

#include "base/progress.h"
#include "truth/benchmark.h"
#include "truth/truth.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace gnomon::lab {

namespace {

double milliseconds(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

void measure_embree(Bench& out, const truth::Tracer& tracer, const Stage& stage)
{
    scene::Light hard = stage.lights.front();
    hard.image = {}; // whose texels would ask for samples of their own
    const truth::RawThroughput raw = truth::raw_packets(tracer, stage.view, hard);
    const auto begin = std::chrono::steady_clock::now();
    const truth::Primary primary = tracer.primary(stage.view);
    tracer.visibility(stage.view, primary, hard, {.samples = 1});
    const double wall = milliseconds(begin);
    const double packets = raw.primary_ms + raw.shadow_ms;
    out.embree_packets_ms = out.embree_packets_ms == 0 ? packets : std::min(out.embree_packets_ms, packets);
    out.truth_ms = out.truth_ms == 0 ? wall : std::min(out.truth_ms, wall);
}

double own_ms(gpu::Device& device, shadow::SceneGpu& scene, const Stage& stage, const std::string& technique, int repeats)
{
    const Choice choice = parse_choice(technique);
    if (!shadow::refusal(*choice.info, device, stage.lights.front()).empty()) return 0.0;
    return render(device, scene, stage, choice, {.repeats = repeats, .lit = false}).technique_ms;
}

} // namespace

Bench bench(gpu::Device& device, const BenchOptions& options)
{
    Stage stage = open_stage(options.stage);
    stage.lights.resize(1);
    Bench out{device.info().name, device.info().driver, stage.scene_name, std::string(scene::kind_name(stage.lights.front().kind())),
        options.reference, stage.view.size, stage.scene.triangle_count(), 0, 0, 0, 0, {}};
    base::Progress progress("bench " + out.scene, options.techniques.size() + 1);
    const truth::Tracer tracer(stage.scene);
    out.bvh_ms = tracer.build_ms();
    shadow::SceneGpu scene(device, stage.scene);
    measure_embree(out, tracer, stage);
    double before = own_ms(device, scene, stage, options.reference, options.repeats);
    out.reference_ms = before;
    for (const std::string& text : options.techniques) {
        const Choice choice = parse_choice(text);
        BenchRow row{text, shadow::refusal(*choice.info, device, stage.lights.front()), 0, 0, 0, 0, 0, 0, 0, {}, {}};
        if (row.skipped.empty()) {
            const Rendered rendered = render(device, scene, stage, choice, {.repeats = options.repeats, .count = true, .lit = false});
            row.passes = rendered.passes, row.counts = rendered.counts;
            for (const PassStats& pass : rendered.passes)
                if (pass.name == "gbuffer") row.gbuffer_ms = pass.ms, row.gbuffer_deviation = pass.deviation;
            row.technique_ms = rendered.technique_ms, row.technique_deviation = rendered.technique_deviation;
        }
        const double after = own_ms(device, scene, stage, options.reference, options.repeats);
        if (before > 0.0) row.reference_ratio = row.technique_ms / (0.5 * (before + after));
        out.reference_ms += after;
        before = after;
        out.rows.push_back(row);
        measure_embree(out, tracer, stage);
        progress.advance();
    }
    measure_embree(out, tracer, stage);
    out.reference_ms /= double(options.techniques.size() + 1);
    for (BenchRow& row : out.rows) {
        const double ms = row.gbuffer_ms + row.technique_ms;
        row.ratio = ms / out.embree_packets_ms, row.dynamic_ratio = ms / (out.embree_packets_ms + out.bvh_ms);
    }
    return out;
}

std::string bench_table(const Bench& b)
{
    std::string out = fmt::format(
        "{} ({})\n{}: {} triangles, {} light, {}x{}\n", b.device, b.driver, b.scene, b.triangles, b.light, b.size.width, b.size.height);
    out += fmt::format("Embree, packets, primary + shadow rays: {:.1f} ms; truth's own: {:.1f} ms ({:.2f}x); BVH build {:.1f} ms\n",
        b.embree_packets_ms, b.truth_ms, b.truth_ms / b.embree_packets_ms, b.bvh_ms);
    out += fmt::format("reference: {}, {:.2f} ms\n", b.reference, b.reference_ms);
    out += fmt::format(
        "{:<32} {:>18} {:>20} {:>10} {:>10} {:>11}\n", "technique", "G-buffer ms", "own passes ms", "x Embree", "with BVH", "x reference");
    for (const BenchRow& row : b.rows) {
        if (!row.skipped.empty())
            out += fmt::format("{:<32} skipped: {}\n", row.technique, row.skipped);
        else
            out += fmt::format("{:<32} {:>9.2f} +-{:>6.2f} {:>11.2f} +-{:>6.2f} {:>10.2f} {:>10.2f} {:>11.2f}\n", row.technique,
                row.gbuffer_ms, row.gbuffer_deviation, row.technique_ms, row.technique_deviation, row.ratio, row.dynamic_ratio,
                row.reference_ratio);
        for (const PassStats& pass : row.passes) out += fmt::format("    {:<28} {:>9.2f} +-{:>6.2f}\n", pass.name, pass.ms, pass.deviation);
        for (const auto& [name, count] : row.counts) out += fmt::format("    {:<28} {:>9}\n", name, count);
    }
    return out;
}

nlohmann::ordered_json bench_json(const Bench& b)
{
    nlohmann::ordered_json out = {{"device", b.device}, {"driver", b.driver}, {"scene", b.scene}, {"triangles", b.triangles},
        {"light", b.light}, {"size", {b.size.width, b.size.height}}, {"embree_packets_ms", b.embree_packets_ms}, {"truth_ms", b.truth_ms},
        {"bvh_ms", b.bvh_ms}, {"reference", b.reference}, {"reference_ms", b.reference_ms}, {"rows", nlohmann::ordered_json::array()}};
    for (const BenchRow& row : b.rows) {
        nlohmann::ordered_json r = {{"technique", row.technique}};
        if (!row.skipped.empty())
            r["skipped"] = row.skipped;
        else
            r.update(nlohmann::ordered_json{{"gbuffer_ms", row.gbuffer_ms}, {"gbuffer_deviation", row.gbuffer_deviation},
                {"technique_ms", row.technique_ms}, {"technique_deviation", row.technique_deviation}, {"ratio", row.ratio},
                {"dynamic_ratio", row.dynamic_ratio}, {"reference_ratio", row.reference_ratio}});
        if (!row.counts.empty()) r["counts"] = row.counts;
        out["rows"].push_back(r);
    }
    return out;
}

} // namespace gnomon::lab
