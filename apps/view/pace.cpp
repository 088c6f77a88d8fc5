// SPDX-License-Identifier: Apache-2.0
#include "pace.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace gnomon::view {

void Pace::add(double frame_ms, const Session& session)
{
    frames_ms.push_back(frame_ms);
    pictures_ms += session.drawn_ms;
    coarse += session.coarse();
    const Picture& picture = session.picture();
    for (const auto* list : {&picture.receiver_times(), &picture.left().times, &picture.compose_times()})
        for (const gpu::PassTime& pass : *list) passes_ms[pass.name] += pass.ms;
}

double Pace::seconds() const { return 1e-3 * std::accumulate(frames_ms.begin(), frames_ms.end(), 0.0); }
double Pace::frames_per_second() const { return frames_ms.empty() ? 0.0 : double(frames_ms.size()) / seconds(); }

double Pace::slowest_ms() const
{
    if (frames_ms.empty()) return 0;
    std::vector<double> sorted = frames_ms;
    const auto at = sorted.begin() + long(sorted.size() * 19 / 20);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

std::string paces_text(const std::vector<Pace>& paces, const Options& options)
{
    std::string text
        = fmt::format("{} at {}x{}, {}:\n", options.stage.scene, options.stage.size.width, options.stage.size.height, options.technique);
    for (const Pace& p : paces) {
        text += fmt::format(
            "  {:5.1f} pictures a second, {}; one in twenty takes {:.0f} ms or more; {:.0f} % of the time is the panel and the "
            "window; {} of {} at half the width and height\n",
            p.frames_per_second(), p.name, p.slowest_ms(), 100.0 * (1.0 - 1e-3 * p.pictures_ms / std::max(p.seconds(), 1e-9)), p.coarse,
            p.frames_ms.size());
        for (const auto& [name, ms] : p.passes_ms) text += fmt::format("    {:7.2f} ms  {}\n", ms / double(p.frames_ms.size()), name);
    }
    return text;
}

nlohmann::ordered_json paces_json(const std::vector<Pace>& paces, const Options& options)
{
    nlohmann::ordered_json json = {{"scene", options.stage.scene}, {"technique", options.technique},
        {"size", {options.stage.size.width, options.stage.size.height}}, {"seconds", options.measure}};
    for (const Pace& p : paces) {
        nlohmann::ordered_json passes = nlohmann::ordered_json::object();
        for (const auto& [name, ms] : p.passes_ms) passes[name] = ms / double(p.frames_ms.size());
        json["measurements"].push_back({{"name", p.name}, {"frames", p.frames_ms.size()}, {"frames_per_second", p.frames_per_second()},
            {"one_in_twenty_ms", p.slowest_ms()}, {"pictures_ms", p.pictures_ms}, {"coarse_frames", p.coarse}, {"passes_ms", passes}});
    }
    return json;
}

} // namespace gnomon::view
