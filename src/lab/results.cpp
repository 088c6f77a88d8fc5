// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

namespace gnomon::lab {

namespace {

void add_sequence(nlohmann::ordered_json& out, const SequenceNumbers& sequence)
{
    out["sequence"] = {{"motion", sequence.motion}, {"followed", sequence.followed}, {"lost", sequence.lost}, {"moved", sequence.moved}};
    out["frames"] = nlohmann::ordered_json::array();
    for (size_t t = 0; t < sequence.mae.size(); ++t) {
        out["frames"].push_back({{"mae", sequence.mae[t]}});
        if (t > 0) out["frames"].back()["change"] = sequence.change[t - 1];
    }
}

} // namespace

nlohmann::ordered_json run_json(const Run& run)
{
    nlohmann::ordered_json out = {{"technique", run.technique}, {"scene", run.scene}, {"camera", run.camera}, {"light", run.light},
        {"size", {run.size.width, run.size.height}}, {"params", nlohmann::ordered_json::parse(run.params)}};
    if (!run.skipped.empty()) {
        out["skipped"] = run.skipped;
        return out;
    }
    out["passes"] = nlohmann::ordered_json::array();
    for (const PassStats& pass : run.passes)
        out["passes"].push_back({{"name", pass.name}, {"ms", pass.ms}, {"deviation", pass.deviation}, {"count", pass.count}});
    out["technique_ms"] = run.technique_ms;
    out["technique_deviation"] = run.technique_deviation;
    out["technique_least_ms"] = run.technique_least_ms;
    out["bytes"] = run.bytes;
    if (!run.counts.empty()) out["counts"] = run.counts;
    out["metrics"] = run.metrics;
    if (!run.reference.empty()) out["reference"] = run.reference;
    if (!run.reference_refused.empty()) out["reference_refused"] = run.reference_refused;
    out["scored_pixels"] = run.scored_pixels;
    out["excluded_pixels"] = run.excluded_pixels;
    if (!run.sequence.motion.empty()) add_sequence(out, run.sequence);
    out["truth"] = {{"samples", run.truth_samples}, {"noise", run.truth_noise}};
    return out;
}

namespace {

std::string cell(const Run& run, const char* metric, const char* format)
{
    const auto found = run.metrics.find(metric);
    return found == run.metrics.end() ? "-" : fmt::format(fmt::runtime(format), found->second);
}

/// The differences to the reference technique, where one was given.
std::string filter_table(const Comparison& comparison)
{
    std::string out;
    for (const Run& run : comparison.runs) {
        if (run.reference.empty() && run.reference_refused.empty()) continue;
        if (out.empty())
            out = fmt::format("\n{:<20} {:<14} {:>9} {:>9} {:>9} {:>9} {:>9}  {}\n", "technique", "light", "mean abs", "rms", "max",
                "lighter", "darker", "against");
        if (run.reference.empty()) {
            out += fmt::format("{:<20} {:<14} not measured: {}\n", run.technique, run.light, run.reference_refused);
            continue;
        }
        out += fmt::format("{:<20} {:<14}", run.technique, run.light);
        for (const char* metric : {"filter_mae", "filter_rms", "filter_max", "filter_leak", "filter_dark"})
            out += fmt::format(" {:>9}", cell(run, metric, "{:.5f}"));
        out += fmt::format("  {}\n", run.reference);
    }
    return out;
}

/// How the errors change along the motion, where one was given.
std::string sequence_table(const Comparison& comparison)
{
    std::string out;
    for (const Run& run : comparison.runs) {
        if (run.sequence.motion.empty()) continue;
        if (out.empty())
            out = fmt::format(
                "\n{:<20} {:<14} {:>9} {:>9} {:>9} {:>9}  {}\n", "technique", "light", "flicker", "swimming", "popping", "noise", "motion");
        out += fmt::format("{:<20} {:<14}", run.technique, run.light);
        for (const char* metric : {"flicker", "swimming", "popping", "temporal_noise"})
            out += fmt::format(" {:>9}", cell(run, metric, "{:.6f}"));
        out += fmt::format("  {}\n", run.sequence.motion);
    }
    return out;
}

} // namespace

nlohmann::ordered_json results_json(const Comparison& comparison)
{
    nlohmann::ordered_json out = {{"device", comparison.device}, {"driver", comparison.driver}, {"commit", comparison.commit},
        {"runs", nlohmann::ordered_json::array()}};
    for (const Run& run : comparison.runs) out["runs"].push_back(run_json(run));
    return out;
}

std::string results_table(const Comparison& comparison)
{
    std::string out = fmt::format("{:<20} {:<14} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>17} {:>9}\n", "technique", "light", "wrong",
        "acne", "leak", "mean abs", "rms", "bias", "flip", "ms", "MiB");
    for (const Run& run : comparison.runs) {
        if (!run.skipped.empty()) {
            out += fmt::format("{:<20} {:<14} skipped: {}\n", run.technique, run.light, run.skipped);
            continue;
        }
        out += fmt::format("{:<20} {:<14} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9.2f} +-{:>5.2f} {:>9.2f}\n", run.technique,
            run.light, cell(run, "wrong_pixels", "{:.5f}"), cell(run, "acne", "{:.5f}"), cell(run, "leak", "{:.5f}"),
            cell(run, "mae", "{:.5f}"), cell(run, "rms", "{:.5f}"), cell(run, "bias", "{:+.5f}"), cell(run, "flip", "{:.4f}"),
            run.technique_ms, run.technique_deviation, double(run.bytes) / (1024.0 * 1024.0));
    }
    return out + filter_table(comparison) + sequence_table(comparison);
}

} // namespace gnomon::lab
