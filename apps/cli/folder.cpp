// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "lab/folder.h"
#include "scene/load.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace fs = std::filesystem;

namespace {

void print_files(const Common& common, const std::vector<fs::path>& files)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const fs::path& f : files) {
        json.push_back(f.string());
        if (!common.json) fmt::print("{}\n", f.string());
    }
    if (common.json) fmt::print("{}\n", nlohmann::ordered_json{{"files", json}}.dump(1));
}

std::vector<const shadow::TechniqueInfo*> chosen(const std::vector<std::string>& ids)
{
    if (ids.empty()) return {shadow::techniques().begin(), shadow::techniques().end()};
    std::vector<const shadow::TechniqueInfo*> out;
    for (const std::string& id : ids) out.push_back(&shadow::technique(id));
    return out;
}

} // namespace

int new_technique(const Folder& options)
{
    print_files(options.common, lab::new_technique(lab::project_root(), options.ids.front()));
    return 0;
}

int picture(const Folder& options)
{
    const auto techniques = chosen(options.ids);
    const fs::path root = lab::project_root();
    const auto device = open_device(options.common);
    if (options.scenes) {
        print_files(options.common, lab::make_scene_pictures(*device, root));
        demand_valid(*device);
        return 0;
    }
    base::Progress progress("pictures", techniques.size());
    std::vector<fs::path> files;
    for (const shadow::TechniqueInfo* info : techniques) {
        const std::string reason = info->unavailable ? info->unavailable(*device) : "";
        if (!reason.empty())
            fmt::print(stderr, "gnomon: {} is skipped: {}\n", info->id, reason);
        else
            files.push_back(lab::make_picture(*device, *info, root / "techniques" / info->id));
        progress.advance();
    }
    demand_valid(*device);
    print_files(options.common, files);
    return 0;
}

int docs(const Folder& options)
{
    const std::vector<fs::path> changed = lab::update_docs(lab::project_root(), options.check);
    print_files(options.common, changed);
    if (options.check && !changed.empty()) base::fail("{} pages are stale; run `gnomon docs` and commit what it changes", changed.size());
    return 0;
}

int bless(const Folder& options)
{
    const auto techniques = chosen(options.ids);
    const fs::path root = lab::project_root();
    const auto device = open_device(options.common);
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const shadow::TechniqueInfo* info : techniques) {
        const std::string text = lab::bless(*device, *info, root / "techniques" / info->id, options.because);
        json.push_back(text);
        if (!options.common.json) fmt::print("{}", text);
    }
    demand_valid(*device);
    if (options.common.json) fmt::print("{}\n", nlohmann::ordered_json{{"blessed", json}}.dump(1));
    return 0;
}

int convert(const Convert& options)
{
    const fs::path folder = options.output.empty() ? fs::path("out") / "scenes" : fs::path(options.output);
    std::vector<fs::path> files;
    for (const auto& [name, text] : scene::convert_scene_list(options.list, fs::absolute(fs::path(options.list)).parent_path())) {
        files.push_back(folder / (name + ".json"));
        base::write_text(files.back(), text);
    }
    print_files(options.common, files);
    return 0;
}

} // namespace gnomon::cli
