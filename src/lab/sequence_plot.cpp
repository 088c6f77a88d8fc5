// SPDX-License-Identifier: Apache-2.0
#include "lab/plot.h"
#include "lab/sequence.h"
#include "metrics/metrics.h"

#include <fmt/format.h>

namespace gnomon::lab {

base::Picture change_display(const base::Picture& map)
{
    const base::Picture none(map.size, 1), no_variance;
    const std::vector<uint8_t> all(map.size.area(), 1);
    return metrics::signed_heat_map({map, none, no_variance, all}, 0.25f);
}

std::string draw_changes(const std::vector<Run>& runs, const std::string& light, const std::filesystem::path& file)
{
    std::vector<PlotSeries> series;
    std::string motion;
    for (const Run& run : runs) {
        if (run.light != light || run.sequence.motion.empty()) continue;
        motion = run.sequence.motion;
        series.push_back({run.name, series.size(), 0, true, {}});
        for (size_t t = 0; t < run.sequence.change.size(); ++t)
            series.back().points.push_back({fmt::format("{}", t + 1), double(t + 1), run.sequence.change[t], 0});
    }
    PlotSpec spec;
    spec.file = file.stem().string();
    spec.title = fmt::format("Change of the error, {}: {}", light, motion);
    spec.x_label = "frame", spec.y_label = "mean absolute change";
    return draw_series(spec, std::move(series), file);
}

} // namespace gnomon::lab
