// SPDX-License-Identifier: Apache-2.0
#include "lab/experiment_expand.h"

#include "base/error.h"
#include "base/names.h"
#include "lab/json_keys.h"
#include "lab/motion.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

namespace gnomon::lab {

namespace {

constexpr size_t most_cells = 100'000;

bool name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::string substituted_text(const std::string& text, const AxisValues& axes, std::vector<std::string>& used, const Json** whole)
{
    std::string out;
    for (size_t at = 0; at < text.size();) {
        if (text[at] != '$') {
            out += text[at++];
            continue;
        }
        size_t end = at + 1;
        while (end < text.size() && name_character(text[end])) ++end;
        const std::string name = text.substr(at + 1, end - at - 1);
        const auto found = axes.find(name);
        if (found == axes.end()) {
            std::vector<std::string> names;
            for (const auto& [axis, value] : axes) names.push_back(axis);
            if (names.empty()) base::fail("'{}' names an axis, but there is no \"axes\" object", text);
            base::fail("'{}': {}", text, base::unknown_name("axis", name, names));
        }
        used.push_back(name);
        if (at == 0 && end == text.size()) *whole = &found->second;
        out += scalar_text(found->second);
        at = end;
    }
    return out;
}

/// One entry of "scenes", "cameras", "lights" or "techniques": a text, or an object that may have a label.
struct Named {
    std::string text, label;
    Json object; ///< null for a text
};

/// The list under `many` or the one thing under `one`.
std::vector<Json> list_of(const Json& json, const std::string& one, const std::string& many)
{
    if (json.contains(one) && json.contains(many)) base::fail("both \"{}\" and \"{}\" are given; keep one of them", one, many);
    if (json.contains(one)) return {json[one]};
    if (!json.contains(many)) return {};
    if (!json[many].is_array() || json[many].empty()) base::fail("\"{}\" is a list with at least one entry", many);
    return {json[many].begin(), json[many].end()};
}

std::string string_of(const Json& value, const std::string& what)
{
    if (!value.is_string()) base::fail("{} is a text, not {}", what, value.dump().substr(0, 60));
    return value.get<std::string>();
}

Named named(const Json& entry, const std::string& key, const std::vector<std::string>& keys, const std::filesystem::path& file)
{
    if (entry.is_string()) return {entry.get<std::string>(), entry.get<std::string>(), {}};
    known_keys(entry, keys, file);
    if (!entry.contains(key)) base::fail("{} lacks \"{}\"", entry.dump().substr(0, 80), key);
    Named out{string_of(entry[key], key), "", entry};
    out.label = entry.contains("label") ? string_of(entry["label"], "label") : out.text;
    return out;
}

/// Every combination of the axes, the last one fastest.
std::vector<AxisValues> combinations(const Json& json, Experiment& out)
{
    std::vector<AxisValues> all(1);
    if (!json.contains("axes")) return all;
    if (!json["axes"].is_object()) base::fail("\"axes\" is an object of name: [values]");
    for (const auto& [name, values] : json["axes"].items()) {
        if (name.empty() || !std::all_of(name.begin(), name.end(), name_character))
            base::fail("the axis '{}' has a name that is not made of letters, digits and _", name);
        for (const auto* taken : {&identity_columns(), &number_columns()})
            if (std::find(taken->begin(), taken->end(), name) != taken->end())
                base::fail("the axis '{}' has the name of a column that every row has; name it otherwise", name);
        if (!values.is_array() || values.empty()) base::fail("the axis '{}' is a list with at least one value", name);
        std::vector<AxisValues> next;
        std::vector<std::string> texts;
        for (const Json& value : values) texts.push_back(scalar_text(value));
        std::sort(texts.begin(), texts.end());
        if (const auto twice = std::adjacent_find(texts.begin(), texts.end()); twice != texts.end())
            base::fail("the axis '{}' has the value {} twice", name, *twice);
        if (all.size() * texts.size() > most_cells) base::fail("the axes have more than {} combinations", most_cells);
        for (const AxisValues& before : all)
            for (const Json& value : values) (next.push_back(before), next.back()[name] = value);
        all = std::move(next);
        out.axes.push_back(name);
    }
    return all;
}

class Expander {
public:
    Expander(const Json& json, Experiment& out)
        : json_(json)
        , out_(out)
        , axes_(combinations(json, out))
        , techniques_(list_of(json, "technique", "techniques"))
    {
        if (techniques_.empty()) base::fail("\"techniques\" is missing: a list of {{\"technique\": ID, \"params\": {{...}}}}");
    }

    void run()
    {
        std::vector<Json> scenes = list_of(json_, "scene", "scenes");
        if (scenes.empty()) base::fail("\"scenes\" is missing: a list of built-in scenes or files");
        for (const Json& scene : scenes)
            for (const Json& camera : part(scene, "camera", "cameras", ""))
                for (const Json& light : part(scene, "light", "lights", ""))
                    for (const Json& size : part(scene, "size", "sizes", "640x360"))
                        for (const AxisValues& axes : axes_)
                            for (size_t t = 0; t < techniques_.size(); ++t) add(scene, camera, light, size, axes, t);
        for (const std::string& axis : out_.axes)
            if (std::find(used_.begin(), used_.end(), axis) == used_.end())
                base::fail("the axis '{}' is used nowhere; write \"${}\" where its value belongs", axis, axis);
        group();
    }

private:
    /// A scene's own list goes before the experiment's.
    std::vector<Json> part(const Json& scene, const std::string& one, const std::string& many, const char* otherwise) const
    {
        std::vector<Json> own = scene.is_object() ? list_of(scene, one, many) : std::vector<Json>();
        if (own.empty()) own = list_of(json_, one, many);
        return own.empty() ? std::vector<Json>{otherwise} : own;
    }

    /// A preset may lie beside the experiment.
    std::string beside_file(const std::string& choice) const
    {
        if (!choice.starts_with('@')) return choice;
        const std::string name = choice.substr(1, choice.find(':') - 1);
        const std::filesystem::path beside = out_.file.parent_path() / name;
        if (std::filesystem::exists(name) || !std::filesystem::is_regular_file(beside)) return choice;
        return "@" + beside.string() + choice.substr(1 + name.size());
    }

    Json fill(const Json& value, const AxisValues& axes) { return substituted(value, axes, used_); }

    void add(const Json& scene_in, const Json& camera_in, const Json& light_in, const Json& size_in, const AxisValues& axes, size_t index)
    {
        if (out_.cells.size() >= most_cells) base::fail("the experiment has more than {} combinations", most_cells);
        const std::filesystem::path& file = out_.file;
        const Named scene = named(fill(scene_in, axes), "scene",
            {"scene", "label", "detail", "time", "gltf_scene", "camera", "cameras", "light", "lights", "size", "sizes"}, file);
        const Named camera = named(fill(camera_in, axes), "camera", {"camera", "label"}, file);
        const Named light = named(fill(light_in, axes), "light", {"light", "label"}, file);
        const std::string size = string_of(fill(size_in, axes), "size");
        const Named technique = named(fill(techniques_[index], axes), "technique", {"technique", "label", "params", "reference"}, file);
        Cell cell{{}, {}, parse_choice(beside_file(technique.text)), {}, {}, {}};
        if (json_.contains("motion")) {
            cell.motion = string_of(fill(json_["motion"], axes), "motion");
            parse_motion(cell.motion);
        }
        if (technique.object.contains("params")) cell.choice.params.set_json(technique.object["params"]);
        const Json reference = technique.object.contains("reference") ? technique.object["reference"] : json_.value("reference", Json());
        if (!reference.is_null()) {
            const Named r = named(fill(reference, axes), "technique", {"technique", "params"}, file);
            cell.reference = parse_choice(beside_file(r.text));
            if (r.object.contains("params")) cell.reference->params.set_json(r.object["params"]);
        }
        cell.stage.scene = scene.text;
        // a scene file may lie beside the experiment
        const std::filesystem::path beside = file.parent_path() / scene.text;
        if (std::filesystem::is_regular_file(beside) && !std::filesystem::exists(scene.text)) cell.stage.scene = beside.string();
        if (!scene.object.is_null())
            cell.stage.load = {scene.object.value("time", 0.0), scene.object.value("detail", 1.0),
                whole_number(scene.object, "gltf_scene", -1, -1, 1 << 20)};
        cell.stage.camera = camera.text;
        if (!light.text.empty()) cell.stage.lights = {light.text};
        cell.stage.size = parse_size(size);
        cell.columns
            = {{"technique", technique.label}, {"scene", scene.label}, {"camera", camera.label}, {"light", light.label}, {"size", size}};
        for (const auto& [name, value] : axes) cell.columns[name] = scalar_text(value);
        out_.cells.push_back(std::move(cell));
    }

    /// Cells of one stage together, stages in the order in which they first came: truth and references are made once.
    void group()
    {
        std::map<std::string, size_t> first;
        std::vector<std::pair<size_t, size_t>> order;
        for (size_t i = 0; i < out_.cells.size(); ++i) order.emplace_back(first.try_emplace(stage_text(out_.cells[i]), i).first->second, i);
        std::sort(order.begin(), order.end());
        std::vector<Cell> sorted;
        for (const auto& [stage, i] : order) sorted.push_back(std::move(out_.cells[i]));
        out_.cells = std::move(sorted);
        unsigned kinds = ~0u; // where no light is named, one that all techniques take
        for (const Cell& c : out_.cells) kinds &= c.choice.info->lights;
        for (Cell& c : out_.cells) c.stage.kinds = kinds ? kinds : ~0u;
        std::set<std::map<std::string, std::string>> rows;
        for (const Cell& c : out_.cells)
            if (!rows.insert(c.columns).second)
                base::fail("two combinations are both called '{}, {}, {}'; give the techniques, scenes, cameras or lights that differ a "
                           "\"label\" each",
                    c.columns.at("technique"), c.columns.at("scene"), c.columns.at("light"));
    }

    const Json& json_;
    Experiment& out_;
    std::vector<AxisValues> axes_;
    std::vector<Json> techniques_;
    std::vector<std::string> used_;
};

} // namespace

Json substituted(const Json& value, const AxisValues& axes, std::vector<std::string>& used)
{
    if (value.is_string()) {
        const Json* whole = nullptr;
        const std::string text = substituted_text(value.get<std::string>(), axes, used, &whole);
        return whole ? *whole : Json(text);
    }
    if (!value.is_structured()) return value;
    Json out = value;
    for (Json& element : out) element = substituted(element, axes, used);
    return out;
}

void expand(const Json& json, Experiment& out) { Expander(json, out).run(); }

} // namespace gnomon::lab
