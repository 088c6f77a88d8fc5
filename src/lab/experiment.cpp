// SPDX-License-Identifier: Apache-2.0
#include "lab/experiment.h"

#include "base/error.h"
#include "base/file.h"
#include "lab/experiment_expand.h"
#include "lab/json_keys.h"
#include "metrics/metrics.h"
#include "metrics/temporal.h"

#include <algorithm>

namespace gnomon::lab {

namespace fs = std::filesystem;

const std::vector<std::string>& identity_columns()
{
    static const std::vector<std::string> names = {"technique", "scene", "camera", "light", "size"};
    return names;
}

const std::vector<std::string>& number_columns()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> out = {"ms", "ms_deviation", "gbuffer_ms", "passes", "mib", "scored_pixels", "excluded_pixels", "flip"};
        for (const metrics::Metric& m : metrics::metrics()) out.emplace_back(m.id);
        for (const metrics::Metric& m : metrics::filter_metrics()) out.emplace_back(m.id);
        for (const metrics::Metric& m : metrics::temporal_metrics()) out.emplace_back(m.id);
        return out;
    }();
    return names;
}

bool is_number_column(const std::string& name)
{
    return std::find(number_columns().begin(), number_columns().end(), name) != number_columns().end()
        || (name.rfind("pass:", 0) == 0 && name.size() > 5) || (name.rfind("count:", 0) == 0 && name.size() > 6);
}

std::string scalar_text(const Json& value)
{
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number() || value.is_boolean()) return value.dump();
    base::fail("'{}' is no number, text, true or false", value.dump().substr(0, 60));
}

namespace {

Experiment parse(const Json& json, const fs::path& file)
{
    Experiment out;
    out.file = file;
    const fs::path absolute = fs::absolute(file);
    out.name = (file.filename() == "experiment.json" ? absolute.parent_path().filename() : file.stem()).string();
    known_keys(json,
        {"title", "about", "scene", "scenes", "camera", "cameras", "light", "lights", "size", "sizes", "axes", "technique", "techniques",
            "reference", "motion", "metrics", "truth_samples", "warm_up", "repeats", "frame", "tables", "plots"},
        file);
    out.title = json.value("title", out.name), out.about = json.value("about", "");
    out.truth_samples = whole_number(json, "truth_samples", 256, 1, 1 << 20);
    out.warm_up = whole_number(json, "warm_up", 1, 1, 10000);
    out.repeats = whole_number(json, "repeats", 3, 1, 10000);
    out.frame_index = uint32_t(whole_number(json, "frame", 0, 0, 1 << 30));
    expand(json, out);
    open_stages(out);
    read_outputs(json, out);
    finish_keys(out);
    return out;
}

} // namespace

Experiment read_experiment(const fs::path& file)
{
    const std::string text = base::read_text(file);
    return naming(file, [&] { return parse(parse_json(text, file), file); });
}

} // namespace gnomon::lab
