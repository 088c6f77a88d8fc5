// SPDX-License-Identifier: Apache-2.0
#include "lab/export_impl.h"
#include "lab/export_readme.h"

#include <set>

namespace gnomon::lab {

namespace {

std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// What a sampler of that name is (gpu::Sampler).
std::string sampler_text(const std::string& name)
{
    const bool compare = name.starts_with("compare"), linear = name.find("linear") != std::string::npos;
    std::string out = linear ? "linear" : "nearest";
    if (compare) return out + ", compares GREATER_OR_EQUAL, border 0";
    return out + (name.ends_with("clamp") ? ", clamp to edge" : name.ends_with("repeat") ? ", repeat" : ", mirrored repeat");
}

class PassText {
public:
    PassText(const Json& recipe, const Json& pass)
        : recipe_(recipe)
        , pass_(pass)
    {
    }

    std::string write(const std::string& title)
    {
        out_ = fmt::format("### {} ({})\n\n", title, text(pass_["kind"]));
        transfer();
        for (size_t i = 0; i < programs().size(); ++i) program(i);
        bindings();
        constants();
        targets();
        state();
        draws();
        dispatch();
        return out_;
    }

private:
    const Json& programs() const
    {
        static const Json none = Json::array();
        return pass_.contains("programs") ? pass_["programs"] : none;
    }
    const Json& shader(const Json& stem) const { return recipe_["shaders"][stem.get<std::string>()]; }
    void line(const std::string& s) { out_ += "- " + s + "\n"; }

    void transfer()
    {
        const std::string kind = pass_["kind"];
        if (kind == "copy image") line(fmt::format("all layers and mips of `{}` to `{}`", text(pass_["from"]), text(pass_["to"])));
        if (kind == "copy buffer")
            line(fmt::format("{} bytes from `{}` at {} to `{}` at {}", text(pass_["bytes"]), text(pass_["from"]),
                text(pass_["from_offset"]), text(pass_["to"]), text(pass_["to_offset"])));
        if (kind == "fill buffer")
            line(fmt::format("every 4 bytes of `{}` become {:#x}", text(pass_["buffer"]), pass_["value"].get<uint32_t>()));
        if (kind == "clear image") line(fmt::format("all of `{}` becomes ({})", text(pass_["image"]), numbers(pass_["value"])));
    }

    void program(size_t index)
    {
        const Json& p = programs()[index];
        std::string names, values;
        std::set<uint32_t> said;
        for (const Json& stem : p["shaders"]) {
            names += (names.empty() ? "`" : " + `") + text(stem) + "`";
            if (shader(stem).contains("refused")) names += " (**missing**)";
            for (const Json& s : shader(stem)["specialization"])
                for (const Json& v : p["specialization"])
                    if (v["id"] == s["id"] && said.insert(s["id"].get<uint32_t>()).second)
                        values += fmt::format("{}{} ({}) = {}", values.empty() ? "" : ", ", text(s["name"]), s["id"].get<uint32_t>(),
                            spec_value(s["type"], v["bits"]));
        }
        const std::string number = programs().size() > 1 ? fmt::format("program {}: ", index + 1) : "";
        line(number + names + (values.empty() ? "" : "; specialisation constants: " + values));
    }

    /// What the shaders declare at a place, from whichever stage of whichever program declares it.
    const Json* declared(uint32_t binding) const
    {
        for (const Json& p : programs())
            for (const Json& stem : p["shaders"])
                for (const Json& r : shader(stem)["resources"])
                    if (r["set"] == 0 && r["binding"] == binding) return &r;
        return nullptr;
    }

    void bindings()
    {
        std::string rows;
        for (const Json& b : pass_.value("bindings", Json::array())) {
            const Json* r = b.contains("unused") ? nullptr : declared(b["binding"]);
            if (!r) continue;
            std::string bound;
            if (b.contains("image")) bound = "image " + text(b["image"]) + " as " + text(b["view"]);
            if (b.contains("buffer")) bound = "buffer " + text(b["buffer"]);
            if (b.contains("acceleration_structure")) bound = "the scene's acceleration structure";
            if (b.contains("layers")) bound += fmt::format(", {1} layers from {0}", text(b["layers"][0]), text(b["layers"][1]));
            if (b.contains("mips")) bound += fmt::format(", {1} mips from {0}", text(b["mips"][0]), text(b["mips"][1]));
            if (b.contains("aspect")) bound += ", its " + text(b["aspect"]);
            const std::string use = text(b["use"]);
            const std::string how = b.contains("sampler") ? "sampled: " + sampler_text(b["sampler"])
                : use == "load"                           ? "read"
                : use == "store"                          ? "written"
                : use == "update"                         ? "read and written"
                                                          : use;
            rows += fmt::format("| {} | {} | {} `{}`{} | {} | {} |\n", text(b["binding"]), text((*r)["place"]), text((*r)["type"]),
                text(b["name"]), r->contains("meaning") ? ": " + cell(text((*r)["meaning"])) : "", cell(bound), how);
        }
        if (!rows.empty()) out_ += "\n| binding | place | declared | bound | how |\n| --- | --- | --- | --- | --- |\n" + rows + "\n";
    }

    void constants()
    {
        if (pass_.contains("textures")) line("the scene's textures, at " + table_place());
        if (!pass_.contains("constants")) return;
        const Json& c = pass_["constants"];
        line(fmt::format("constants: {}{} bytes{}", c.contains("members") ? "`" + members_text(c["members"]) + "`, " : "",
            c["bytes"].get<size_t>(), c.contains("place") ? ", at " + text(c["place"]) : ""));
        for (const Json& p : c.value("patches", Json::array()))
            line(fmt::format(
                "before the pass, {} bytes of the constants from {} on are copied from the buffer `{}` at {}, which an earlier pass wrote",
                text(p["bytes"]), text(p["to"]), text(p["buffer"]), text(p["from"])));
    }

    std::string table_place() const
    {
        for (const Json& p : programs())
            for (const Json& stem : p["shaders"])
                for (const Json& r : shader(stem)["resources"])
                    if (r["set"] == 2) return text(r["place"]);
        return "set 2";
    }

    static std::string equation(const Json& b)
    {
        return fmt::format("{} x source {} {} x target", text(b["source"]), text(b["op"]), text(b["target"]));
    }

    static std::string part(const Json& t)
    {
        std::string out;
        if (t.contains("layer")) out += ", from layer " + text(t["layer"]);
        if (t.contains("mip")) out += ", mip " + text(t["mip"]);
        return out;
    }

    void targets()
    {
        size_t location = 0;
        for (const Json& c : pass_.value("colors", Json::array())) {
            const size_t at = location++;
            if (!c.contains("image")) {
                line(fmt::format("colour {}: none; the output is dropped", at));
                continue;
            }
            std::string s = fmt::format("colour {}: `{}` ({}){}, {}", at, text(c["image"]),
                text(recipe_["images"][text(c["image"])]["format"]), part(c),
                c.contains("clear")       ? "cleared to (" + numbers(c["clear"]) + ")"
                    : c["load"] == "keep" ? "kept"
                                          : "old content not needed");
            if (c.contains("blend")) {
                const Json& b = c["blend"];
                if (b.contains("color")) s += fmt::format("; blended: colour {}, alpha {}", equation(b["color"]), equation(b["alpha"]));
                s += ", write mask " + (text(b["write_mask"]).empty() ? "none" : text(b["write_mask"]));
            }
            if (c.contains("resolve")) s += ", resolved into `" + text(c["resolve"]) + "`";
            line(s);
        }
        if (pass_.contains("depth")) depth(pass_["depth"]);
    }

    void depth(const Json& d)
    {
        std::string s = fmt::format("depth: `{}` ({}){}, {}, test {}, {}", text(d["image"]),
            text(recipe_["images"][text(d["image"])]["format"]), part(d),
            d.contains("clear")       ? "cleared to " + text(d["clear"])
                : d["load"] == "keep" ? "kept"
                                      : "old content not needed",
            text(d["compare"]), d["write"] == true ? "written" : "not written");
        if (d["store"] == false) s += ", not needed afterwards";
        if (d.contains("clear_stencil")) s += ", stencil cleared to " + text(d["clear_stencil"]);
        line(s);
        for (const auto& [key, face] : {std::pair{"stencil_front", "front"}, {"stencil_back", "back"}})
            if (d.contains(key)) {
                const Json& f = d[key];
                line(fmt::format("stencil of {} faces: {} {} (mask {:#x}); fails: {}, depth fails: {}, passes: {}; write mask {:#x}", face,
                    text(f["compare"]), text(f["reference"]), f["compare_mask"].get<uint32_t>(), text(f["fail"]), text(f["depth_fail"]),
                    text(f["pass"]), f["write_mask"].get<uint32_t>()));
            }
    }

    void state()
    {
        if (!pass_.contains("topology")) return;
        std::string s = fmt::format("area {} pixels, {}", numbers(pass_["area"], " x "), text(pass_["topology"]));
        if (pass_.contains("layers")) s += fmt::format(", {} layers of the targets, chosen in the vertex shader", text(pass_["layers"]));
        if (pass_.contains("view_mask")) s += fmt::format(", multiview with mask {:#x}", pass_["view_mask"].get<uint32_t>());
        if (pass_.contains("depth_clamp")) s += ", depth clamped instead of clipped";
        line(s);
        size_t stream = 0;
        for (const Json& v : pass_.value("streams", Json::array())) {
            std::string attributes;
            for (const Json& a : v["attributes"])
                attributes += fmt::format(
                    "{}location {} {} at {}", attributes.empty() ? "" : ", ", text(a["location"]), text(a["format"]), text(a["offset"]));
            line(fmt::format("vertex stream {}: {} bytes apart, {}", stream++, text(v["stride"]), attributes));
        }
    }

    void draws()
    {
        for (const Json& d : pass_.value("draws", Json::array())) {
            const Json& first = d["first"];
            const std::string kind = d["kind"];
            std::string s;
            if (kind == "vertices" && d["calls"] == 1 && first["count"] == 3 && first["instances"] == 1 && !d.contains("vertex_buffers"))
                s = "draws one triangle that covers the target: 3 vertices without buffers";
            else if (kind == "vertices" || kind == "indexed")
                s = fmt::format("draws {} times, {} (the first: {} {}, {} instances, first instance {})", text(d["calls"]),
                    kind == "indexed" ? "indexed" : "without indices", text(first["count"]), kind == "indexed" ? "indices" : "vertices",
                    text(first["instances"]), text(first["first_instance"]));
            else
                s = fmt::format("draws indirectly{}: {} calls; the first runs {} commands from `{}` at {}, {} bytes apart",
                    kind == "indexed_indirect" ? ", indexed" : "", text(d["calls"]), text(first["commands"]), text(d["commands"]),
                    text(first["offset"]), text(first["stride"]));
            if (d.contains("vertex_buffers")) {
                std::string names;
                for (const Json& b : d["vertex_buffers"]) names += (names.empty() ? "`" : ", `") + text(b) + "`";
                s += ", vertex buffers " + names;
            }
            if (d.contains("index_buffer")) s += ", index buffer `" + text(d["index_buffer"]) + "`";
            s += ", culls " + text(d["cull"]);
            if (d.contains("depth_bias")) s += ", depth bias (constant, clamp, slope) " + numbers(d["depth_bias"]);
            if (d.contains("viewport_varies")) s += ", viewport of its own for each (the first: " + numbers(d["viewport"]) + ")";
            if (d.contains("scissor_varies")) s += ", scissor of its own for each (the first: " + numbers(d["scissor"]) + ")";
            if (programs().size() > 1) s += fmt::format(", program {}", d["program"].get<size_t>() + 1);
            line(s);
        }
    }

    void dispatch()
    {
        if (pass_.contains("local_size")) line("work group of " + numbers(pass_["local_size"], " x ") + " invocations");
        if (pass_.contains("indirect"))
            line(fmt::format("dispatched indirectly: the numbers of groups lie in `{}` at {}", text(pass_["indirect"]["buffer"]),
                text(pass_["indirect"]["offset"])));
        else if (pass_.contains("threads"))
            line(fmt::format("{} invocations{}", numbers(pass_["threads"], " x "),
                pass_["kind"] == "compute" ? ", so " + numbers(pass_["groups"], " x ") + " groups" : " of the ray generation shader"));
    }

    const Json& recipe_;
    const Json& pass_;
    std::string out_;
};

} // namespace

std::string readme_passes(const Json& recipe)
{
    std::string out = "## The passes\n\nWhere its specialisation constants keep a shader from looking at a binding, the pass gives "
                      "whatever image or buffer is at "
                      "hand: a binding that looks odd is such a one, and anything of its kind will do.\n\n";
    for (const Json& pass : recipe["passes"])
        out += PassText(recipe, pass).write(fmt::format("{}. {}", pass["number"].get<size_t>(), text(pass["name"]))) + "\n";
    if (!recipe.contains("first_frame")) return out;
    out += "## Passes of the first frame alone\n\nWhen scene or light is new: those that no later frame runs, and those that later frames "
           "run on other targets or with other shaders.\n\n";
    for (const Json& pass : recipe["first_frame"]) out += PassText(recipe, pass).write(text(pass["name"])) + "\n";
    return out;
}

} // namespace gnomon::lab
