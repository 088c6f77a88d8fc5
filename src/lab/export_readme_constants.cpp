// SPDX-License-Identifier: Apache-2.0
#include "lab/export_impl.h"
#include "lab/export_readme.h"

#include <algorithm>

namespace gnomon::lab {

namespace {

/// The structs that these members hold, and theirs, each once and before those that hold it.
void gather(const Json& members, const Json& types, std::vector<std::string>& out)
{
    for (const Json& m : members) {
        const std::string type = m["type"];
        if (!types.contains(type) || std::find(out.begin(), out.end(), type) != out.end()) continue;
        gather(types[type]["members"], types, out);
        out.push_back(type);
    }
}

std::string member_type(const Json& m)
{
    std::string out = m["type"];
    for (const Json& side : m.value("array", Json::array())) out += side == 0 ? "[]" : fmt::format("[{}]", side.get<uint32_t>());
    return out;
}

std::string struct_table(const std::string& name, const Json& type)
{
    std::string out = fmt::format("### {}\n\n", name);
    if (type.contains("meaning")) out += type["meaning"].get<std::string>() + "\n\n";
    out += fmt::format("{} bytes.\n\n| offset | member | type | |\n| --- | --- | --- | --- |\n", type["bytes"].get<uint32_t>());
    for (const Json& m : type["members"])
        out += fmt::format("| {} | {} | {} | {} |\n", m["offset"].get<uint32_t>(), m["name"].get<std::string>(), member_type(m),
            cell(m.value("meaning", "")));
    return out + "\n";
}

} // namespace

std::string members_text(const Json& members)
{
    std::string out;
    for (const Json& m : members) out += (out.empty() ? "" : ", ") + member_type(m) + " " + m["name"].get<std::string>();
    return out;
}

std::string readme_constants(const Json& recipe)
{
    std::vector<std::pair<std::string, std::string>> blocks; // what it holds -> passes
    std::vector<std::string> structs;
    for (const Json& pass : recipe["passes"]) {
        if (!pass.contains("constants") || !pass["constants"].contains("members")) continue;
        const Json& constants = pass["constants"];
        const std::string text = fmt::format("`{}`, {} bytes", members_text(constants["members"]), constants["bytes"].get<size_t>());
        gather(constants["members"], recipe["types"], structs);
        const auto known = std::find_if(blocks.begin(), blocks.end(), [&](const auto& b) { return b.first == text; });
        const std::string number = pass["number"].dump();
        if (known == blocks.end())
            blocks.emplace_back(text, number);
        else
            known->second += ", " + number;
    }
    std::string out = "## Constants\n\n";
    if (blocks.empty()) out += "No pass has any.\n\n";
    for (const auto& [text, numbers_of] : blocks) out += fmt::format("- pass {}: {}\n", numbers_of, text);
    const std::string id = recipe["technique"]["id"];
    out += fmt::format(
        "\nThe host fills them each frame. `passes.json` has the values that Gnomon gave in the recorded frame, member by member, to "
        "compare one's own with. The C++ that computes them is `techniques/{0}/{0}.cpp` in Gnomon's sources and what it calls in "
        "`src/shadow/parts/`; how the method works, what it costs and where it fails is in `techniques/{0}/README.md`.\n\n",
        id);
    for (const auto& [stem, shader] : recipe["shaders"].items())
        for (const Json& r : shader["resources"])
            if (r.contains("members")) gather(r["members"], recipe["types"], structs);
    for (const std::string& name : structs) out += struct_table(name, recipe["types"][name]);
    return out;
}

} // namespace gnomon::lab
