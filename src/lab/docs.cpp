// SPDX-License-Identifier: Apache-2.0
#include "lab/docs_reliability.h"
#include "lab/folder.h"

#include "base/error.h"
#include "base/file.h"
#include "lab/gallery.h"
#include "lab/quality.h"

#include <nlohmann/json.hpp>

#include <set>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string parameter_table(const shadow::TechniqueInfo& info)
{
    const shadow::ParamValues values(info.params());
    if (values.table().fields.empty()) return "None.\n";
    std::string out = "| name | default | allowed | unit | meaning |\n| --- | --- | --- | --- | --- |\n";
    for (const shadow::ParamInfo& p : values.table().fields) {
        std::string allowed = p.type == shadow::ParamType::flag ? "on, off" : fmt::format("{} to {}", p.range.min, p.range.max);
        if (!p.choices.empty()) allowed = fmt::format("{}", fmt::join(p.choices, ", "));
        out += fmt::format("| `{}` | {} | {} | {} | {} |\n", p.name, values.text(p), allowed, p.unit, p.help);
    }
    return out;
}

std::string cost_table(const Json& results)
{
    if (results.is_null()) return "Not measured yet: `gnomon picture` does.\n";
    std::string out = fmt::format("On {} ({}).\n\n| light | size | pass | ms | deviation |\n| --- | --- | --- | --- | --- |\n",
        results.at("device").get<std::string>(), results.at("driver").get<std::string>());
    for (const Json& run : results.at("runs")) {
        if (run.contains("skipped")) continue;
        const std::string light = run.at("light"), size = fmt::format("{}x{}", run.at("size")[0].get<int>(), run.at("size")[1].get<int>());
        for (const Json& pass : run.at("passes"))
            out += fmt::format("| {} | {} | {} | {:.2f} | {:.2f} |\n", light, size, pass.at("name").get<std::string>(),
                pass.at("ms").get<double>(), pass.at("deviation").get<double>());
        out += fmt::format("| {} | {} | **the technique's own** | **{:.2f}** | {:.2f} |\n", light, size,
            run.at("technique_ms").get<double>(), run.at("technique_deviation").get<double>());
        out += fmt::format("| {} | {} | memory beyond the images of the contract | {:.2f} MiB | |\n", light, size,
            run.at("bytes").get<double>() / 1048576.0);
    }
    return out;
}

std::string error_table(const Json& results)
{
    if (results.is_null()) return "Not measured yet: `gnomon picture` does.\n";
    std::string out = "| scene | light | metric | value |\n| --- | --- | --- | --- |\n";
    std::set<std::string> references;
    for (const Json& run : results.at("runs")) {
        if (run.contains("skipped")) continue;
        for (const auto& [metric, value] : run.at("metrics").items())
            out += fmt::format("| {} | {} | {} | {:.5g} |\n", run.at("scene").get<std::string>(), run.at("light").get<std::string>(),
                metric, value.get<double>());
        if (run.contains("reference")) references.insert(run.at("reference").get<std::string>());
    }
    if (!references.empty()) out += fmt::format("\nThe filter metrics are against `{}`.\n", fmt::join(references, "`, `"));
    return out;
}

/// Replaces what stands between the markers of `name`; the text is unchanged where they are missing.
std::string with_block(const std::string& text, const std::string& name, const std::string& content)
{
    const std::string open = "<!-- generated:" + name + " -->", close = "<!-- /generated -->";
    const size_t begin = text.find(open);
    const size_t end = begin == std::string::npos ? begin : text.find(close, begin);
    if (end == std::string::npos) return text;
    return text.substr(0, begin + open.size()) + "\n" + content + text.substr(end);
}

std::string overview_table()
{
    std::string out = "| technique | family | lights | output | after |\n| --- | --- | --- | --- | --- |\n";
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        out += fmt::format("| [{}]({}/README.md) | {} | {} | {}{} | {} |\n", info->title, info->id, info->family,
            fmt::join(claimed_kinds(*info), ", "), shadow::output_name(info->output), info->textured ? " (coloured)" : "", info->cite);
    return out;
}

} // namespace

std::vector<fs::path> update_docs(const fs::path& root, bool check)
{
    std::vector<fs::path> changed;
    const auto update = [&](const fs::path& file, const std::vector<std::pair<std::string, std::string>>& blocks) {
        if (!fs::exists(file)) base::fail("{} is missing; every technique has a page (copy techniques/_template/README.md)", file.string());
        const std::string before = base::read_text(file);
        std::string after = before;
        for (const auto& [name, content] : blocks) after = with_block(after, name, content);
        if (after == before) return;
        changed.push_back(file);
        if (!check) base::write_text(file, after);
    };
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        const fs::path folder = root / "techniques" / info->id;
        if (!fs::is_directory(folder)) continue; // a technique of another root
        const Json results = measured(folder);
        update(
            folder / "README.md", {{"parameters", parameter_table(*info)}, {"cost", cost_table(results)}, {"error", error_table(results)}});
    }
    update(root / "techniques" / "README.md", {{"techniques", overview_table()}});
    for (const fs::path& file : update_thumbnails(root, check)) changed.push_back(file);
    for (const fs::path& file : update_result_pages(root, check)) changed.push_back(file);
    if (const fs::path file = root / "src" / "shadow" / "quality.json"; fs::exists(file)) {
        const std::string priced = priced_qualities(root);
        if (priced != base::read_text(file)) {
            changed.push_back(file);
            if (!check) base::write_text(file, priced);
        }
        update(root / "docs" / "quality.md", {{"qualities", qualities_page(shadow::parse_qualities(priced))}});
    }
    update(root / "README.md", {{"pictures", picture_grid(root)}});
    update(root / "docs" / "gallery.md", {{"gallery", gallery(root)}});
    if (const fs::path page = root / "docs" / "reliability.md"; fs::exists(page)) update(page, {{"reliability", reliability_tables(root)}});
    return changed;
}

} // namespace gnomon::lab
