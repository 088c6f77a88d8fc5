// SPDX-License-Identifier: Apache-2.0
#include "lab/figures.h"

#include "device.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace fs = std::filesystem;

int figures(const Figures& options)
{
    const lab::Figures figures = lab::read_figures(options.file);
    const fs::path folder = options.output.empty() ? fs::absolute(options.file).parent_path() : fs::path(options.output);
    const auto device = open_device(options.common);
    const auto files = lab::draw_figures(*device, figures, folder);
    demand_valid(*device);
    nlohmann::ordered_json json = {{"files", nlohmann::ordered_json::array()}};
    for (const fs::path& f : files) json["files"].push_back(f.string());
    if (options.common.json)
        fmt::print("{}\n", json.dump(1));
    else
        fmt::print("{} pictures and {}\n", files.size() - 1, files.back().string());
    return 0;
}

} // namespace gnomon::cli
