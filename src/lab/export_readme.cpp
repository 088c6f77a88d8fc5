// SPDX-License-Identifier: Apache-2.0
#include "lab/export_readme.h"

#include "lab/export_impl.h"

#include <bit>

namespace gnomon::lab {

namespace {

std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::string heading(const Json& recipe)
{
    const Json& t = recipe["technique"];
    std::string languages[] = {"GLSL for Vulkan", "HLSL", "Metal", "SPIR-V"};
    const std::string language = languages[size_t(parse_language(recipe["language"]))];
    const std::string output = t["output"];
    std::string out = fmt::format("# {} for a {} light, in {}\n\n", text(t["title"]), text(recipe["light"]), language);
    out += fmt::format("{}. Written by {} from what the technique `{}` recorded for the scene `{}`, a view of {} pixels and the parameters "
                       "below. Sizes and counts that depend on scene and view are those of that frame. The same, for programs to read: "
                       "`passes.json`, with the values of all constants.\n\n",
        text(t["cite"]), text(recipe["generator"]), text(t["id"]), text(recipe["scene"]), numbers(recipe["view"], " x "));
    const std::string contract = output == "visibility"
        ? "the fraction of the light's area that reaches each pixel's surface: 1 = lit, 0 = in full shadow, and 1 on the background. "
          "Multiply the light's unshadowed contribution by it"
        : output == "transmittance" ? "the fraction of the light that reaches each pixel's surface in each colour channel. Multiply the "
                                      "light's unshadowed contribution by it"
                                    : "an image of kind " + output;
    out += fmt::format("**What comes out:** the image `{}`, {}.\n\n", output, contract);
    if (recipe["temporal"] == true)
        out += "**It keeps state between frames**: resources of origin *kept* live as long as scene and light do. The passes are those of "
               "a "
               "frame that has one before it.\n\n";
    return out;
}

std::string pass_overview(const Json& recipe)
{
    std::string out = "## The passes in short\n\nIn this order, on one queue; each waits for the writes before it.\n\n"
                      "| | pass | kind | shaders | writes |\n| --- | --- | --- | --- | --- |\n";
    std::map<size_t, std::string> writes;
    for (const char* kind : {"images", "buffers"})
        for (const auto& [name, resource] : recipe[kind].items())
            for (const Json& pass : resource["written_by"]) {
                std::string& list = writes[pass.get<size_t>()];
                list += (list.empty() ? "" : ", ") + name;
            }
    for (const Json& pass : recipe["passes"]) {
        std::string shaders;
        for (const Json& program : pass.value("programs", Json::array())) {
            shaders += shaders.empty() ? "" : "; ";
            for (const Json& s : program["shaders"]) shaders += (s == program["shaders"][0] ? "" : " + ") + s.get<std::string>();
        }
        out += fmt::format("| {} | {} | {} | {} | {} |\n", pass["number"].get<size_t>(), cell(pass["name"]), text(pass["kind"]), shaders,
            cell(writes[pass["number"].get<size_t>()]));
    }
    return out + "\n";
}

std::string files(const Json& recipe)
{
    std::string out = "## Files\n\n| file | |\n| --- | --- |\n";
    std::string refused;
    for (const auto& [stem, shader] : recipe["shaders"].items()) {
        if (shader.contains("file"))
            out += fmt::format("| `{}` | {} shader; as written, with comments: `{}` |\n", text(shader["file"]), text(shader["stage"]),
                text(shader["source"]));
        else
            refused += fmt::format("- `{}` ({} shader): {}.\n", stem, text(shader["stage"]), text(shader["refused"]));
    }
    out += "| `layouts.h` | the structs of constants blocks and buffers, for C++ |\n"
           "| `passes.json` | all that is said here, and the constants' values |\n"
           "| `source/` | the GLSL that these files were made from, with its comments: read it there, run it here |\n";
    for (const char* kind : {"images", "buffers"})
        for (const auto& [name, resource] : recipe[kind].items())
            if (resource.contains("data"))
                out += fmt::format(
                    "| `{}` | content of the {} `{}` |\n", text(resource["data"]), std::string(kind, strlen(kind) - 1), name);
    if (!refused.empty())
        out += "\n**Missing**, because the language cannot say it:\n\n" + refused + "\nWithout them the passes that use them cannot run.\n";
    return out + "\n";
}

std::string parameters(const Json& recipe)
{
    if (recipe["parameters"].empty()) return "";
    std::string out = "## Parameters\n\nChange them with `--set name=value` and export again: some choose passes, others sizes, others "
                      "lie in the constants.\n\n| parameter | value | |\n| --- | --- | --- |\n";
    for (const Json& p : recipe["parameters"]) {
        const std::string unit = p["unit"];
        out += fmt::format("| {} | {}{} | {}{} |\n", text(p["name"]), text(p["value"]), unit.empty() ? "" : " " + unit, cell(p["help"]),
            p["value"] == p["default"] ? "" : " (default: " + text(p["default"]) + ")");
    }
    return out + "\n";
}

} // namespace

std::string cell(std::string s)
{
    for (size_t i = 0; (i = s.find('|', i)) != std::string::npos; i += 2) s.insert(i, "\\");
    return s;
}

std::string numbers(const Json& array, const char* between)
{
    std::string out;
    for (const Json& n : array) out += (out.empty() ? "" : between) + n.dump();
    return out;
}

std::string spec_value(const std::string& type, uint32_t bits)
{
    if (type == "bool") return bits ? "true" : "false";
    if (type == "float") return fmt::format("{}", std::bit_cast<float>(bits));
    return type == "int" ? fmt::format("{}", int32_t(bits)) : fmt::format("{}", bits);
}

std::string image_size(const Json& image)
{
    const std::string size = numbers(image["size"], " x ");
    return image.contains("size_is") ? fmt::format("{} ({})", text(image["size_is"]), size) : size;
}

std::string readme(const Json& recipe)
{
    return heading(recipe) + pass_overview(recipe) + files(recipe) + parameters(recipe) + readme_conventions(recipe)
        + readme_resources(recipe) + readme_constants(recipe) + readme_passes(recipe);
}

} // namespace gnomon::lab
