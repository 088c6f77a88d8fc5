// SPDX-License-Identifier: Apache-2.0
#include "lab/export_impl.h"

#include <algorithm>
#include <set>

namespace gnomon::lab {

namespace {

using gpu::BufferId;
using gpu::ImageId;
using gpu::Use;

template <class Listed> std::vector<std::string> unique_names(const std::vector<Listed>& resources)
{
    std::vector<std::string> out;
    for (const Listed& r : resources) {
        std::string name = r.desc.name;
        for (int n = 2; std::find(out.begin(), out.end(), name) != out.end(); ++n) name = fmt::format("{} {}", r.desc.name, n);
        out.push_back(name);
    }
    return out;
}

/// Which passes read and write a resource.
struct Users {
    std::set<size_t> readers, writers;
};

class Uses {
public:
    explicit Uses(const Recording& r)
    {
        for (pass_ = 0; pass_ < r.passes.size(); ++pass_) std::visit([&](const auto& work) { add(work); }, r.passes[pass_]->work);
    }
    std::map<uint32_t, Users> images, buffers;

private:
    void read(ImageId i) { images[i.index].readers.insert(pass_); }
    void write(ImageId i) { images[i.index].writers.insert(pass_); }
    void read(BufferId b) { buffers[b.index].readers.insert(pass_); }
    void write(BufferId b) { buffers[b.index].writers.insert(pass_); }
    template <class Id> void use(Id id, Use how)
    {
        const bool writes = how == Use::store || how == Use::update || how == Use::copy_to || how == Use::color || how == Use::depth;
        if (writes) write(id);
        if (!writes || how == Use::update) read(id);
    }
    void bound(const std::vector<gpu::Binding>& bindings, const gpu::Constants& constants)
    {
        for (const gpu::Binding& b : bindings) {
            if (b.image) use(b.image, b.use);
            if (b.buffer) use(b.buffer, b.use);
        }
        for (const gpu::Constants::Patch& p : constants.patches) read(p.source);
    }
    void add(const gpu::ComputePass& p)
    {
        bound(p.bindings, p.constants);
        if (p.indirect) read(p.indirect);
    }
    void add(const gpu::RayPass& p) { bound(p.bindings, p.constants); }
    void add(const gpu::RasterPass& p)
    {
        bound(p.bindings, p.constants);
        for (const auto& [buffer, how] : p.buffers) use(buffer, how);
        for (const gpu::ColorTarget& c : p.colors) {
            if (!c.image) continue;
            write(c.image);
            if (c.load == gpu::Load::keep) read(c.image);
            if (c.resolve) write(c.resolve);
        }
        if (!p.depth) return;
        if (p.depth->load == gpu::Load::keep) read(p.depth->image);
        if (p.depth->write || p.depth->stencil) write(p.depth->image);
    }
    void add(const gpu::CopyImage& c) { read(c.from), write(c.to); }
    void add(const gpu::CopyBuffer& c) { read(c.from), write(c.to); }
    void add(const gpu::FillBuffer& f) { write(f.buffer); }
    void add(const gpu::ClearImage& c) { write(c.image); }

    size_t pass_ = 0; ///< from 0
};

/// "view", "view/4" ... where a size follows from the view's so, else "".
std::string of_view(gpu::Size size, gpu::Size view)
{
    for (int part = 1; part <= 64; part *= 2)
        if (size.width == (view.width + part - 1) / part && size.height == (view.height + part - 1) / part && size.width > 8)
            return part == 1 ? "view" : fmt::format("view/{}", part);
    return "";
}

struct Meaning {
    ImageId image;
    const char* text;
};

/// The contract of shadow/gbuffer.h and shadow/technique.h.
std::string given_by_host(const shadow::Frame& frame, ImageId id)
{
    const shadow::GBuffer& g = frame.gbuffer;
    const Meaning meanings[]
        = {{g.depth, "depth of the view, reversed: 1 at the near plane, 0 = background (at infinity, or an orthographic far plane)"},
            {g.normal,
                "two normals, unit, in world space, both turned to the eye's side of the surface: x = shading normal, y = geometric normal "
                "of the triangle; each octahedral in two snorm16 (x in the low half)"},
            {g.primitive,
                "id of the visible triangle, counted over the whole scene: Instance.first_primitive + the triangle's number "
                "within its mesh; 0xffffffff = background"},
            {g.albedo, "base colour"}, {g.surface, "metallic, roughness, 0, 0"}, {g.emissive, "emitted radiance"},
            {g.motion, "uv of the point now minus its uv in the previous frame"}};
    for (const Meaning& m : meanings)
        if (m.image && m.image == id) return m.text;
    return "";
}

std::string given_by_host(shadow::SceneGpu& scene, const gpu::Buffer* buffer)
{
    const std::pair<const gpu::Buffer*, const char*> meanings[]
        = {{&scene.positions(), "positions of all meshes one after another, 3 floats each, in object space"},
            {&scene.attributes(), "beside each position: octahedral snorm16x2 normal (uint), uv (2 floats), rgba8 colour (uint)"},
            {&scene.indices(), "indices of all meshes one after another, uint32, three a triangle, counted from the mesh's first vertex"},
            {&scene.instances(), "one Instance an instance of a mesh: rows of world_from_object, ids, material, place of its mesh"},
            {&scene.materials(), "one Material each"}, {&scene.previous_positions(), "positions of the previous frame"},
            {&scene.previous_instances(), "instances of the previous frame"},
            {&scene.casters(), "one Caster an instance: its world bounds and its draw"}};
    for (const auto& [known, text] : meanings)
        if (known == buffer) return text;
    return "";
}

Json image_json(const Recording& r, uint32_t index)
{
    const auto& listed = r.list.images[index];
    const gpu::ImageDesc& d = listed.desc;
    Json out = {{"format", gpu::format_name(d.format)}, {"size", {d.size.width, d.size.height}}};
    if (const std::string part = of_view(d.size, r.frame.view.size); !part.empty()) out["size_is"] = part;
    out.update({{"layers", d.layers}, {"mips", d.mips}, {"samples", int(d.samples)}});
    if (d.cube) out["cube"] = true;
    const std::string given = given_by_host(r.frame, {index});
    if (index == r.frame.output.index)
        out["origin"] = "output";
    else if (!given.empty())
        out.update({{"origin", "host"}, {"meaning", given}});
    else
        out["origin"] = listed.imported ? "kept" : "transient";
    return out;
}

Json buffer_json(const Recording& r, uint32_t index)
{
    const auto& listed = r.list.buffers[index];
    Json out = {{"bytes", listed.desc.bytes}};
    const std::string given = listed.imported ? given_by_host(r.frame.resources, listed.imported) : "";
    if (!given.empty())
        out.update({{"origin", "host"}, {"meaning", given}});
    else
        out["origin"] = listed.imported ? "kept" : "transient";
    return out;
}

void add_users(Json& resource, const Users& users)
{
    for (const auto& [key, passes] : {std::pair{"written_by", &users.writers}, {"read_by", &users.readers}}) {
        resource[key] = Json::array();
        for (const size_t pass : *passes) resource[key].push_back(pass + 1);
    }
    // content that no pass has made: from the CPU, or from the frame before
    const bool read_first = !users.readers.empty() && (users.writers.empty() || *users.readers.begin() <= *users.writers.begin());
    if (resource["origin"] == "kept" && read_first) resource["needs_content"] = true;
}

} // namespace

Recording::Recording(const gpu::PassList& passes_of, const shadow::Frame& f, std::string_view technique)
    : list(gpu::contents(passes_of))
    , frame(f)
    , images(unique_names(list.images))
    , buffers(unique_names(list.buffers))
{
    const std::string prefix = std::string(technique) + "/";
    for (const gpu::Pass& pass : list.passes) {
        if (!pass.name.starts_with(prefix)) continue;
        passes.push_back(&pass);
        names.push_back(pass.name.substr(prefix.size()));
    }
}

Json describe_resources(const Recording& r)
{
    const Uses uses(r);
    Json out = {{"images", Json::object()}, {"buffers", Json::object()}};
    for (const auto& [index, users] : uses.images) {
        Json& image = out["images"][r.images[index]] = image_json(r, index);
        add_users(image, users);
    }
    for (const auto& [index, users] : uses.buffers) {
        Json& buffer = out["buffers"][r.buffers[index]] = buffer_json(r, index);
        add_users(buffer, users);
    }
    return out;
}

} // namespace gnomon::lab
