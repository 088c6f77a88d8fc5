// SPDX-License-Identifier: Apache-2.0
#include "lab/curves.h"

#include "commands.h"

#include "lab/folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace fs = std::filesystem;

int curves(const Curves& options)
{
    const fs::path folder = options.output.empty() ? lab::project_root() / "experiments" / "sampling_error" : fs::path(options.output);
    std::vector<std::string> notes;
    const std::vector<fs::path> files = lab::write_curves(lab::error_curves(), folder, notes);
    nlohmann::ordered_json json = {{"files", nlohmann::ordered_json::array()}, {"notes", notes}};
    for (const fs::path& f : files) json["files"].push_back(f.string());
    if (options.common.json) {
        fmt::print("{}\n", json.dump(1));
        return 0;
    }
    for (const fs::path& f : files) fmt::print("{}\n", f.string());
    for (const std::string& note : notes) fmt::print("{}\n", note);
    return 0;
}

} // namespace gnomon::cli
