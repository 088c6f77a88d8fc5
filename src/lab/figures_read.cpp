// SPDX-License-Identifier: Apache-2.0
#include "lab/figures.h"

#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/names.h"
#include "lab/json_keys.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

const std::vector<std::string> shows = {
    "lit", "visibility", "error", "filter_error", "slice", "texel_footprint", "texel_footprint_perspective", "texel_footprint_projection"};
/// What a figure says for all its panels and a panel for itself.
const std::vector<std::string> panel_keys = {"label", "technique", "quantity", "show", "scene", "detail", "camera", "light", "size",
    "reference", "gain", "crop", "zoom", "slice_centre", "slice_right", "slice_up", "slice_height"};

float number_of(const Json& j, const char* key, float otherwise, float low, float high, const fs::path& file)
{
    const double number = j.value(key, double(otherwise));
    if (!(number >= double(low) && number <= double(high)))
        base::fail("{}: '{}' is {:g}; it takes {:g} to {:g}", file.string(), key, number, low, high);
    return float(number);
}

vec3 vector_of(const Json& v, const char* key, const fs::path& file)
{
    constexpr double farthest = 1e9; // metres, as on the command line
    vec3 out(0);
    for (size_t i = 0; i < 3; ++i) {
        if (!v.is_array() || v.size() != 3 || !v[i].is_number() || !(std::abs(v[i].get<double>()) <= farthest))
            base::fail("{}: '{}' is not a list of three numbers of at most {:g}", file.string(), key, farthest);
        out[int(i)] = v[i].get<float>();
    }
    return out;
}

std::array<int, 4> crop_of(const Json& v, const fs::path& file)
{
    std::array<int, 4> out{};
    for (size_t i = 0; i < out.size(); ++i) {
        if (!v.is_array() || v.size() != out.size() || !v[i].is_number_integer() || v[i] < 0 || v[i] > base::longest_side)
            base::fail("{}: 'crop' is not [x, y, width, height] in whole pixels up to {}", file.string(), base::longest_side);
        out[i] = v[i].get<int>();
    }
    return out;
}

Show show_of(const std::string& text, const fs::path& file)
{
    const auto at = std::ranges::find(shows, text);
    if (at == shows.end()) base::fail("{}: {}", file.string(), base::unknown_name("show", text, shows));
    return Show(at - shows.begin());
}

truth::Quantity quantity_of(const std::string& text, const fs::path& file)
{
    const std::vector<std::string> names = {"visibility", "transmittance"};
    const auto at = std::ranges::find(names, text);
    if (at == names.end()) base::fail("{}: {}", file.string(), base::unknown_name("quantity", text, names));
    return truth::Quantity(at - names.begin());
}

FigurePanel panel_of(const Json& j, const fs::path& file)
{
    FigurePanel p;
    p.technique = j.value("technique", "");
    if (p.technique.empty()) base::fail("{}: a panel names no technique, nor \"truth\"", file.string());
    p.label = j.value("label", p.technique);
    p.show = show_of(j.value("show", "lit"), file);
    p.quantity = quantity_of(j.value("quantity", "visibility"), file);
    p.stage.scene = j.value("scene", "contact");
    if (const fs::path beside = file.parent_path() / p.stage.scene; fs::is_regular_file(beside) && !fs::exists(p.stage.scene))
        p.stage.scene = beside.string();
    p.stage.load.detail = j.value("detail", 1.0);
    p.stage.camera = j.value("camera", "");
    if (j.contains("light")) p.stage.lights = {j["light"].get<std::string>()};
    p.stage.size = parse_size(j.value("size", "320x240"));
    p.reference = j.value("reference", "");
    p.gain = number_of(j, "gain", 1.0f, 1e-6f, 1e6f, file);
    p.zoom = whole_number(j, "zoom", 1, 1, 16);
    if (j.contains("crop")) p.crop = crop_of(j["crop"], file);
    if (j.contains("slice_centre")) p.slice.centre = vector_of(j["slice_centre"], "slice_centre", file);
    if (j.contains("slice_right")) p.slice.right = vector_of(j["slice_right"], "slice_right", file);
    if (j.contains("slice_up")) p.slice.up = vector_of(j["slice_up"], "slice_up", file);
    p.slice.height = number_of(j, "slice_height", 0.0f, 0.0f, 1e9f, file);
    if (p.technique != "truth") parse_choice(p.technique);
    if (p.show == Show::filter_error) {
        if (p.reference.empty()) base::fail("{}: the panel '{}' shows filter_error and names no reference", file.string(), p.label);
        parse_choice(p.reference);
    }
    return p;
}

Figure figure_of(const Json& j, const fs::path& file)
{
    std::vector<std::string> keys = panel_keys;
    keys.insert(keys.end(), {"id", "title", "text", "columns", "panels"});
    known_keys(j, keys, file);
    Figure figure;
    figure.id = j.value("id", ""), figure.title = j.value("title", ""), figure.text = j.value("text", "");
    if (figure.id.empty() || figure.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-.") != std::string::npos)
        base::fail(
            "{}: '{}' cannot be the id of a figure; ids are made of small letters, digits, '_', '-' and '.'", file.string(), figure.id);
    figure.columns = whole_number(j, "columns", 3, 1, 8);
    if (!j.contains("panels") || !j["panels"].is_array() || j["panels"].empty())
        base::fail("{}: the figure '{}' has no list of panels", file.string(), figure.id);
    for (const Json& own : j["panels"]) {
        known_keys(own, panel_keys, file);
        Json all = j;
        all.update(own);
        figure.panels.push_back(panel_of(all, file));
    }
    return figure;
}

} // namespace

Figures read_figures(const fs::path& file)
{
    try {
        const Json j = parse_json(base::read_text(file), file);
        known_keys(j, {"title", "about", "figures", "truth_samples"}, file);
        Figures out{j.value("title", ""), j.value("about", ""), {}, whole_number(j, "truth_samples", 256, 1, 1 << 20)};
        for (const Json& figure : j.at("figures")) out.figures.push_back(figure_of(figure, file));
        return out;
    } catch (const nlohmann::json::exception& e) {
        base::fail("{}: {}", file.string(), e.what());
    }
}

} // namespace gnomon::lab
