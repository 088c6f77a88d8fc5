// SPDX-License-Identifier: Apache-2.0
#include "lab/export_impl.h"
#include "lab/export_readme.h"

#include <set>

namespace gnomon::lab {

namespace {

std::string passes(const Json& numbers_of)
{
    if (numbers_of.empty()) return "";
    // "1, 2, 3, 4" of twenty passes tells less than "1-4"
    std::string out;
    for (size_t i = 0; i < numbers_of.size();) {
        size_t end = i;
        while (end + 1 < numbers_of.size() && numbers_of[end + 1].get<size_t>() == numbers_of[end].get<size_t>() + 1) ++end;
        out += (out.empty() ? "" : ", ") + numbers_of[i].dump();
        if (end > i) out += (end > i + 1 ? "-" : ", ") + numbers_of[end].dump();
        i = end + 1;
    }
    return out;
}

std::string image_row(const std::string& name, const Json& image)
{
    std::string shape = image_size(image);
    if (image["layers"] > 1 || image.contains("cube")) shape += fmt::format(", {} layers", image["layers"].get<int>());
    if (image["mips"] > 1) shape += fmt::format(", {} mips", image["mips"].get<int>());
    if (image["samples"] > 1) shape += fmt::format(", {} samples", image["samples"].get<int>());
    return fmt::format("| {} | {} | {} | {} | {} |\n", cell(name), image["format"].get<std::string>(), shape, passes(image["written_by"]),
        passes(image["read_by"]));
}

/// How a resource of the technique's own gets what is read before any pass wrote it.
std::string content(const std::string& name, const Json& resource)
{
    if (resource.contains("data"))
        return fmt::format("- `{}` is the same for every scene: `{}` holds its bytes.\n", name, resource["data"].get<std::string>());
    if (!resource["written_by"].empty()) return fmt::format("- `{}` holds what the frame before left in it.\n", name);
    return fmt::format(
        "- `{}` is made by the CPU from scene, light or view before the passes, by the C++ that is named under *Constants*.\n", name);
}

/// What the shaders declare a buffer to hold: the longest of their views of it.
std::string holds(const Json& recipe, const std::string& buffer)
{
    std::string out;
    for (const Json& pass : recipe["passes"])
        for (const Json& b : pass.value("bindings", Json::array())) {
            if (b.value("buffer", "") != buffer) continue;
            for (const Json& program : pass["programs"])
                for (const Json& stem : program["shaders"])
                    for (const Json& r : recipe["shaders"][stem.get<std::string>()]["resources"]) {
                        if (r["set"] != 0 || r["binding"] != b["binding"] || !r.contains("members")) continue;
                        const std::string view = members_text(r["members"]);
                        if (view.size() > out.size()) out = view;
                    }
        }
    return out;
}

std::string host_gives(const Json& recipe)
{
    std::string out;
    for (const auto& [name, image] : recipe["images"].items())
        if (image["origin"] == "host")
            out += fmt::format("| image {} | {}, {} | {} | {} |\n", name, image["format"].get<std::string>(), image_size(image),
                image["meaning"].get<std::string>(), passes(image["read_by"]));
    std::set<std::string> drawn;
    for (const Json& pass : recipe["passes"])
        for (const Json& draw : pass.value("draws", Json::array())) {
            for (const Json& b : draw.value("vertex_buffers", Json::array())) drawn.insert(b);
            if (draw.contains("index_buffer")) drawn.insert(draw["index_buffer"].get<std::string>());
        }
    for (const auto& [name, buffer] : recipe["buffers"].items())
        if (buffer["origin"] == "host")
            out += fmt::format("| buffer {} | {} bytes here | {} | {} |\n", name, buffer["bytes"].get<uint64_t>(),
                buffer["meaning"].get<std::string>(), passes(buffer["read_by"]));
    const std::pair<const char*, const char*> streams[]
        = {{"positions", "vertex buffer: positions of all meshes one after another, 3 floats each, in object space"},
            {"attributes", "vertex buffer, beside each position: octahedral snorm16x2 normal (uint), uv (2 floats), rgba8 colour (uint)"},
            {"indices", "index buffer: uint32, three a triangle, counted from the mesh's first vertex"}};
    for (const auto& [name, meaning] : streams)
        if (drawn.count(name) && !recipe["buffers"].contains(name)) out += fmt::format("| buffer {} | | {} | draws |\n", name, meaning);
    bool textures = false, accel = false;
    for (const Json& pass : recipe["passes"]) {
        textures |= pass.contains("textures");
        for (const Json& b : pass.value("bindings", Json::array())) accel |= b.contains("acceleration_structure");
    }
    if (textures)
        out += "| textures | array of sampled 2D images | the materials' textures (`Material`, `TextureUse` in `layouts.h` hold the "
               "indices), each with a sampler of its own | set 2 |\n";
    if (accel)
        out += "| acceleration structure | top level | opaque and masked triangles of all instances; the custom index of an instance is "
               "its place in the buffer `instances`; masked geometry is not flagged opaque | bindings |\n";
    return out;
}

} // namespace

std::string readme_resources(const Json& recipe)
{
    std::string out = "## What the host gives\n\n| | format, size | meaning | read by |\n| --- | --- | --- | --- |\n" + host_gives(recipe);
    out += "\nThe constants of each pass, too: see below.\n\n## What the passes make\n\n*Transient* ones live for the frame and may share "
           "memory; "
           "*kept* ones stay.\n\n| image | format | size | written by | read by |\n| --- | --- | --- | --- | --- |\n";
    std::string contents;
    for (const auto& [name, image] : recipe["images"].items()) {
        if (image["origin"] == "host") continue;
        out += image_row(name + (image["origin"] == "kept" ? " (kept)" : image["origin"] == "output" ? " (**the result**)" : ""), image);
        if (image.contains("needs_content")) contents += content(name, image);
    }
    std::string buffers;
    for (const auto& [name, buffer] : recipe["buffers"].items()) {
        if (buffer["origin"] == "host") continue;
        buffers += fmt::format("| {}{} | {} | {} | {} | {} |\n", cell(name), buffer["origin"] == "kept" ? " (kept)" : "",
            cell(holds(recipe, name)), buffer["bytes"].get<uint64_t>(), passes(buffer["written_by"]), passes(buffer["read_by"]));
        if (buffer.contains("needs_content")) contents += content(name, buffer);
    }
    if (!buffers.empty()) out += "\n| buffer | holds | bytes here | written by | read by |\n| --- | --- | --- | --- | --- |\n" + buffers;
    if (!contents.empty()) out += "\nRead before any pass has written them:\n\n" + contents;
    return out + "\n";
}

} // namespace gnomon::lab
