// SPDX-License-Identifier: Apache-2.0
#include "lab/gallery.h"

#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "lab/folder.h"
#include "scene/load.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gnomon::lab {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

using Infos = std::vector<const shadow::TechniqueInfo*>;

fs::path picture_of(const shadow::TechniqueInfo& info) { return fs::path("techniques") / info.id / (std::string(info.id) + ".png"); }
fs::path thumbnail_of(const shadow::TechniqueInfo& info)
{
    return fs::path("docs") / "pictures" / "thumbnails" / (std::string(info.id) + ".png");
}

/// Those that have a picture.
std::map<std::string, Infos> families(const fs::path& root)
{
    std::map<std::string, Infos> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        if (fs::exists(root / picture_of(*info))) out[std::string(info->family)].push_back(info);
    return out;
}

std::vector<std::string> pictured_scenes(const fs::path& root)
{
    std::vector<std::string> out;
    for (const scene::Builtin& builtin : scene::builtins())
        if (fs::exists(root / "docs" / "pictures" / (std::string(builtin.name) + ".png"))) out.emplace_back(builtin.name);
    return out;
}

/// Rows of a table without headings; the last one is filled up.
std::string grid(const std::vector<std::string>& cells, size_t columns)
{
    if (cells.empty()) return "";
    std::string out = "|", rule = "|";
    for (size_t i = 0; i < columns; ++i) out += " |", rule += " --- |";
    out += "\n" + rule + "\n";
    for (size_t i = 0; i < (cells.size() + columns - 1) / columns * columns; ++i) {
        out += "| " + (i < cells.size() ? cells[i] : std::string()) + " ";
        if (i % columns == columns - 1) out += "|\n";
    }
    return out;
}

constexpr base::Size thumbnail_size{160, 120};

/// How strongly the error's panel is coloured there; grey is not scored.
float error_at(const base::Picture& picture, int x, int y)
{
    const int from = 2 * (picture_panel.width + picture_gap);
    const float r = picture.at(from + x, y, 0), g = picture.at(from + x, y, 1), b = picture.at(from + x, y, 2);
    return std::max({r, g, b}) - std::min({r, g, b});
}

/// The part of the first panel, pixel for pixel, in which the error is largest; of an exact technique the middle.
base::Picture crop(const base::Picture& picture)
{
    constexpr int step = 20;
    int left = (picture_panel.width - thumbnail_size.width) / 2, top = (picture_panel.height - thumbnail_size.height) / 2;
    float most = 0;
    for (int y0 = 0; y0 + thumbnail_size.height <= picture_panel.height; y0 += step)
        for (int x0 = 0; x0 + thumbnail_size.width <= picture_panel.width; x0 += step) {
            float sum = 0;
            for (int y = y0; y < y0 + thumbnail_size.height; ++y)
                for (int x = x0; x < x0 + thumbnail_size.width; ++x) sum += error_at(picture, x, y);
            if (sum > most) most = sum, left = x0, top = y0;
        }
    base::Picture out(thumbnail_size, 3);
    for (int y = 0; y < out.size.height; ++y)
        for (int x = 0; x < out.size.width; ++x)
            for (int c = 0; c < 3; ++c) out.at(x, y, c) = picture.at(left + x, top + y, c);
    return out;
}

bool same(const base::Picture& a, const base::Picture& b)
{
    if (a.size.width != b.size.width || a.size.height != b.size.height || a.channels != b.channels) return false;
    for (size_t i = 0; i < a.values.size(); ++i)
        if (std::abs(a.values[i] - b.values[i]) > 1.0f / 255.0f) return false;
    return true;
}

/// Whether the file holds that picture; a file that cannot be read does not.
bool holds(const fs::path& file, const base::Picture& picture)
{
    try {
        return fs::exists(file) && same(base::read_png(file, base::Encoding::linear), picture);
    } catch (const base::Error&) {
        return false;
    }
}

/// What the picture's run cost and erred, in a line; of the metrics those that one looks at first.
std::string summary(const Json& results)
{
    if (results.is_null()) return "";
    for (const Json& run : results.at("runs")) {
        if (run.contains("skipped")) continue;
        const Json& size = run.at("size");
        std::string out = fmt::format("`{}`, {} light, {}x{}: {:.1f} ± {:.1f} ms, {:.1f} MiB", run.at("scene").get<std::string>(),
            run.at("light").get<std::string>(), size[0].get<int>(), size[1].get<int>(), run.at("technique_ms").get<double>(),
            run.at("technique_deviation").get<double>(), run.at("bytes").get<double>() / 1048576.0);
        for (const char* metric : {"mae", "wrong_pixels", "acne", "leak", "penumbra_width"})
            if (run.at("metrics").contains(metric)) out += fmt::format(", {} {:.3g}", metric, run.at("metrics").at(metric).get<double>());
        return out + ".";
    }
    return "";
}

std::string device_line(const fs::path& root)
{
    std::set<std::string> devices;
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        const Json results = measured(root / "techniques" / info->id);
        if (!results.is_null()) devices.insert(results.at("device").get<std::string>() + ", " + results.at("driver").get<std::string>());
    }
    return devices.empty() ? "" : fmt::format("Measured on {}.\n\n", fmt::join(devices, "; and on "));
}

} // namespace

Json measured(const fs::path& folder)
{
    const fs::path file = folder / "results.json";
    if (!fs::exists(file)) return {};
    try {
        return Json::parse(base::read_text(file));
    } catch (const nlohmann::json::exception& e) {
        base::fail("{}: {}; make it again with `gnomon picture`", file.string(), e.what());
    }
}

std::string picture_grid(const fs::path& root)
{
    std::vector<std::string> cells;
    for (const auto& [family, infos] : families(root))
        for (const shadow::TechniqueInfo* info : infos)
            cells.push_back(fmt::format("[![{}]({})](techniques/{}/README.md)<br>[{}](techniques/{}/README.md)", info->title,
                thumbnail_of(*info).generic_string(), info->id, info->title, info->id));
    std::string out = grid(cells, 5);
    const std::vector<std::string> scenes = pictured_scenes(root);
    if (!scenes.empty()) out += fmt::format("\nBuilt-in scenes: `{}`.\n", fmt::join(scenes, "`, `"));
    return out;
}

std::string gallery(const fs::path& root)
{
    std::string out = device_line(root);
    for (const auto& [family, infos] : families(root)) {
        std::string heading = family;
        heading.front() = char(std::toupper(static_cast<unsigned char>(heading.front())));
        out += "## " + heading + "\n\n";
        for (const shadow::TechniqueInfo* info : infos)
            out += fmt::format("**[{}](../techniques/{}/README.md)** ({})\n\n![{}, the truth, and the signed error](../{})\n\n{}\n\n",
                info->title, info->id, info->cite, info->title, picture_of(*info).generic_string(),
                summary(measured(root / "techniques" / info->id)));
    }
    std::vector<std::string> cells;
    for (const std::string& name : pictured_scenes(root)) cells.push_back(fmt::format("![{}](pictures/{}.png)<br>`{}`", name, name, name));
    return out + "## Scenes\n\n" + grid(cells, 4);
}

std::vector<fs::path> update_thumbnails(const fs::path& root, bool check)
{
    std::vector<fs::path> stale;
    std::set<fs::path> wanted;
    for (const auto& [family, infos] : families(root))
        for (const shadow::TechniqueInfo* info : infos) {
            const fs::path file = root / thumbnail_of(*info);
            wanted.insert(file);
            const base::Picture picture = base::read_png(root / picture_of(*info), base::Encoding::linear);
            if (picture.channels < 3 || picture.size.width < 3 * picture_panel.width + 2 * picture_gap
                || picture.size.height < picture_panel.height)
                base::fail("{} is no picture of three panels; `gnomon picture {}` makes it", (root / picture_of(*info)).string(), info->id);
            const base::Picture thumbnail = crop(picture);
            if (holds(file, thumbnail)) continue;
            stale.push_back(file);
            if (!check) base::write_png(file, thumbnail, base::Encoding::linear);
        }
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(root / "docs" / "pictures" / "thumbnails", none)) {
        if (wanted.count(entry.path())) continue;
        stale.push_back(entry.path());
        if (!check) fs::remove(entry.path());
    }
    return stale;
}

} // namespace gnomon::lab
