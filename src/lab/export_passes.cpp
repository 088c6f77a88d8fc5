// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"
#include "lab/export_impl.h"
#include "lab/export_names.h"

#include <algorithm>
#include <bit>

namespace gnomon::lab {

namespace {

using gpu::DrawCall;

std::string file_stem(const std::string& shader) { return shader.substr(shader.rfind('/') + 1); }

Json blend_json(const VkPipelineColorBlendAttachmentState& b)
{
    std::string mask;
    for (int c = 0; c < 4; ++c)
        if (b.colorWriteMask & (1u << c)) mask += "RGBA"[c];
    Json out = {{"write_mask", mask}};
    if (!b.blendEnable) return out;
    const auto equation = [](VkBlendFactor from, VkBlendOp op, VkBlendFactor to) {
        return Json{{"source", name_of(from)}, {"op", name_of(op)}, {"target", name_of(to)}};
    };
    out["color"] = equation(b.srcColorBlendFactor, b.colorBlendOp, b.dstColorBlendFactor);
    out["alpha"] = equation(b.srcAlphaBlendFactor, b.alphaBlendOp, b.dstAlphaBlendFactor);
    return out;
}

Json stencil_json(const VkStencilOpState& s)
{
    return {{"compare", name_of(s.compareOp)}, {"fail", name_of(s.failOp)}, {"depth_fail", name_of(s.depthFailOp)},
        {"pass", name_of(s.passOp)}, {"compare_mask", s.compareMask}, {"write_mask", s.writeMask}, {"reference", s.reference}};
}

Json clear_json(const VkClearColorValue& v, VkFormat format)
{
    Json out = Json::array();
    for (int c = 0; c < gpu::format_info(format).channels; ++c)
        if (gpu::is_integer(format))
            out.push_back(v.uint32[c]);
        else
            out.push_back(v.float32[c]);
    return out;
}

class PassWriter {
public:
    PassWriter(const Recording& r, std::vector<UsedShader>& shaders)
        : r_(r)
        , shaders_(shaders)
    {
    }

    Json write(size_t index)
    {
        out_ = {{"number", index + 1}, {"name", r_.names[index]}};
        programs_.clear();
        std::visit([this](const auto& work) { add(work); }, r_.passes[index]->work);
        return std::move(out_);
    }

private:
    /// The program's place in the pass's list.
    size_t add_program(const gpu::Program& program)
    {
        const auto known = std::find(programs_.begin(), programs_.end(), &program);
        if (known != programs_.end()) return size_t(known - programs_.begin());
        const auto constants = gpu::constants_of(program);
        Json shaders = Json::array(), values = Json::array();
        for (const gpu::StageDescription& s : gpu::stages_of(program)) {
            shaders.push_back(file_stem(s.shader));
            if (std::none_of(shaders_.begin(), shaders_.end(), [&](const UsedShader& u) { return u.name == s.shader; }))
                shaders_.push_back({s.shader, s.stage, {constants.begin(), constants.end()}});
        }
        for (const gpu::SpecConstant& c : constants) values.push_back({{"id", c.id}, {"bits", c.value}});
        out_["programs"].push_back({{"shaders", shaders}, {"specialization", values}});
        programs_.push_back(&program);
        return programs_.size() - 1;
    }

    Json binding_json(uint32_t index, const gpu::Binding& b)
    {
        const gpu::ReflectedBinding* declared = nullptr;
        for (const gpu::Program* p : programs_)
            for (const gpu::ReflectedBinding& d : p->bindings)
                if (!declared && d.set == 0 && d.binding == index) declared = &d;
        Json out = {{"binding", index}};
        if (!declared) {
            out["unused"] = true; // compiled away: nothing has to be bound
            return out;
        }
        out.update({{"name", declared->name}, {"use", name_of(b.use)}});
        if (b.accel) out["acceleration_structure"] = "scene";
        if (b.buffer) out["buffer"] = r_.buffers[b.buffer.index];
        if (!b.image) return out;
        const gpu::ImageDesc& desc = r_.list.images[b.image.index].desc;
        const gpu::ImagePart part = gpu::part_of(b, desc, declared);
        out["image"] = r_.images[b.image.index];
        if (b.use == gpu::Use::sample) out["sampler"] = name_of(b.sampler);
        out["view"] = name_of(part.view);
        if (part.range.layers != desc.layers) out["layers"] = {part.range.first_layer, part.range.layers};
        if (part.range.mips != desc.mips) out["mips"] = {part.range.first_mip, part.range.mips};
        if (part.aspect == VK_IMAGE_ASPECT_STENCIL_BIT) out["aspect"] = "stencil";
        return out;
    }

    /// After the programs: these name the bindings.
    void add_bound(const std::vector<gpu::Binding>& bindings, const gpu::Constants& constants, const gpu::TextureTable* textures)
    {
        out_["bindings"] = Json::array();
        for (uint32_t i = 0; i < bindings.size(); ++i) out_["bindings"].push_back(binding_json(i, bindings[i]));
        if (textures && std::any_of(programs_.begin(), programs_.end(), [](const gpu::Program* p) {
                return std::any_of(p->bindings.begin(), p->bindings.end(), [](const auto& b) { return b.set == 2; });
            }))
            out_["textures"] = true;
        if (constants.bytes.empty()) return;
        out_["constants"] = {{"bytes", constants.bytes.size()}};
        for (const gpu::Constants::Patch& p : constants.patches)
            out_["constants"]["patches"].push_back(
                {{"buffer", r_.buffers[p.source.index]}, {"from", p.source_offset}, {"to", p.offset}, {"bytes", p.bytes}});
    }

    void add_threads(const gpu::Threads& t, const std::array<uint32_t, 3>& local)
    {
        const auto groups = [](uint32_t n, uint32_t size) { return (n + size - 1) / size; };
        out_["threads"] = {t.x, t.y, t.z};
        out_["groups"] = {groups(t.x, local[0]), groups(t.y, local[1]), groups(t.z, local[2])};
    }

    void add(const gpu::ComputePass& p)
    {
        out_["kind"] = "compute";
        add_program(*p.program);
        add_bound(p.bindings, p.constants, p.textures);
        out_["local_size"] = p.program->local_size;
        if (p.indirect)
            out_["indirect"] = {{"buffer", r_.buffers[p.indirect.index]}, {"offset", p.indirect_offset}};
        else
            add_threads(p.threads, p.program->local_size);
    }

    void add(const gpu::RayPass& p)
    {
        out_["kind"] = "rays";
        add_program(*p.program);
        add_bound(p.bindings, p.constants, p.textures);
        add_threads(p.threads, {1, 1, 1});
    }

    void add(const gpu::RasterPass& p)
    {
        out_["kind"] = "raster";
        add_program(*p.program);
        const std::vector<DrawCall> calls = gpu::draw_calls(r_.list, p);
        for (const DrawCall& c : calls) add_program(*c.program);
        add_bound(p.bindings, p.constants, p.textures);
        const gpu::Size size = gpu::render_size(p, r_.list);
        out_["area"] = {size.width, size.height};
        if (p.view_mask)
            out_["view_mask"] = p.view_mask;
        else if (p.layers > 1)
            out_["layers"] = p.layers;
        add_targets(p);
        out_["topology"] = name_of(p.topology);
        if (p.depth_clamp) out_["depth_clamp"] = true;
        if (p.depth_bias) out_["depth_bias"] = true;
        for (const gpu::VertexStream& s : p.streams) {
            Json attributes = Json::array();
            for (const auto& a : s.attributes)
                attributes.push_back({{"location", a.location}, {"format", gpu::format_name(a.format)}, {"offset", a.offset}});
            out_["streams"].push_back({{"stride", s.stride}, {"attributes", attributes}});
        }
        add_draws(calls);
    }

    void add_targets(const gpu::RasterPass& p)
    {
        out_["colors"] = Json::array();
        for (const gpu::ColorTarget& c : p.colors) {
            Json target = Json::object();
            if (c.image) {
                target = {{"image", r_.images[c.image.index]}, {"load", name_of(c.load)}};
                if (c.load == gpu::Load::clear) target["clear"] = clear_json(c.clear, r_.list.images[c.image.index].desc.format);
                if (c.layer) target["layer"] = c.layer;
                if (c.mip) target["mip"] = c.mip;
                if (c.blend) target["blend"] = blend_json(*c.blend);
                if (c.resolve) target["resolve"] = r_.images[c.resolve.index];
            }
            out_["colors"].push_back(std::move(target));
        }
        if (!p.depth) return;
        const gpu::DepthTarget& d = *p.depth;
        Json target = {{"image", r_.images[d.image.index]}, {"load", name_of(d.load)}, {"write", d.write}, {"store", d.store},
            {"compare", name_of(d.compare)}};
        if (d.load == gpu::Load::clear) target["clear"] = d.clear;
        if (d.layer) target["layer"] = d.layer;
        if (gpu::has_stencil(r_.list.images[d.image.index].desc.format) && d.load == gpu::Load::clear)
            target["clear_stencil"] = d.clear_stencil;
        if (d.stencil) target.update({{"stencil_front", stencil_json(d.front)}, {"stencil_back", stencil_json(d.back)}});
        out_["depth"] = std::move(target);
    }

    Json call_json(const DrawCall& c)
    {
        constexpr std::string_view kinds[] = {"vertices", "indexed", "indirect", "indexed_indirect"};
        Json out = {{"program", add_program(*c.program)}, {"kind", kinds[size_t(c.kind)]}};
        if (!c.vertex_buffers.empty()) out["vertex_buffers"] = c.vertex_buffers;
        const bool indexed = c.kind == DrawCall::Kind::indexed || c.kind == DrawCall::Kind::indexed_indirect;
        if (indexed) out["index_buffer"] = c.index_buffer;
        out["cull"] = cull_name(c.cull);
        if (c.depth_bias != std::array<float, 3>{}) out["depth_bias"] = c.depth_bias;
        if (c.commands) out["commands"] = r_.buffers[c.commands.index];
        return out;
    }

    /// Calls that differ in numbers alone are one entry: how many, the numbers of the first, and whether scissor or viewport change.
    void add_draws(const std::vector<DrawCall>& calls)
    {
        std::vector<std::pair<Json, std::vector<const DrawCall*>>> kinds;
        for (const DrawCall& c : calls) {
            Json key = call_json(c);
            if (kinds.empty() || kinds.back().first != key) kinds.emplace_back(std::move(key), 0);
            kinds.back().second.push_back(&c);
        }
        out_["draws"] = Json::array();
        for (auto& [entry, same] : kinds) {
            const DrawCall& c = *same.front();
            entry["calls"] = same.size();
            if (c.commands)
                entry["first"] = {{"offset", c.offset}, {"commands", c.count}, {"stride", c.stride}};
            else
                entry["first"] = {{"count", c.count}, {"instances", c.instances}, {"first", c.first}, {"vertex_offset", c.vertex_offset},
                    {"first_instance", c.first_instance}};
            add_areas(entry, same);
            out_["draws"].push_back(entry);
        }
    }

    static void add_areas(Json& entry, const std::vector<const DrawCall*>& calls)
    {
        const auto scissor = [](const DrawCall* c) {
            return std::array{c->scissor.offset.x, c->scissor.offset.y, int(c->scissor.extent.width), int(c->scissor.extent.height)};
        };
        const auto viewport = [](const DrawCall* c) {
            return std::array{c->viewport.x, c->viewport.y, c->viewport.width, c->viewport.height};
        };
        entry["scissor"] = scissor(calls.front());
        entry["viewport"] = viewport(calls.front());
        for (const DrawCall* c : calls) {
            if (scissor(c) != scissor(calls.front())) entry["scissor_varies"] = true;
            if (viewport(c) != viewport(calls.front())) entry["viewport_varies"] = true;
        }
    }

    void add(const gpu::CopyImage& c)
    {
        out_.update({{"kind", "copy image"}, {"from", r_.images[c.from.index]}, {"to", r_.images[c.to.index]}});
    }
    void add(const gpu::CopyBuffer& c)
    {
        out_.update({{"kind", "copy buffer"}, {"from", r_.buffers[c.from.index]}, {"to", r_.buffers[c.to.index]}, {"bytes", c.bytes},
            {"from_offset", c.from_offset}, {"to_offset", c.to_offset}});
    }
    void add(const gpu::FillBuffer& f)
    {
        out_.update({{"kind", "fill buffer"}, {"buffer", r_.buffers[f.buffer.index]}, {"value", f.value}});
    }
    void add(const gpu::ClearImage& c)
    {
        out_.update({{"kind", "clear image"}, {"image", r_.images[c.image.index]},
            {"value", clear_json(c.value, r_.list.images[c.image.index].desc.format)}});
    }

    const Recording& r_;
    std::vector<UsedShader>& shaders_;
    std::vector<const gpu::Program*> programs_; ///< of the current pass
    Json out_;
};

} // namespace

Json describe_passes(const Recording& r, std::vector<UsedShader>& shaders)
{
    PassWriter writer(r, shaders);
    Json out = Json::array();
    for (size_t i = 0; i < r.passes.size(); ++i) out.push_back(writer.write(i));
    return out;
}

const gpu::Constants* constants_of(const gpu::Pass& pass)
{
    if (const auto* compute = std::get_if<gpu::ComputePass>(&pass.work)) return &compute->constants;
    if (const auto* ray = std::get_if<gpu::RayPass>(&pass.work)) return &ray->constants;
    if (const auto* raster = std::get_if<gpu::RasterPass>(&pass.work)) return &raster->constants;
    return nullptr;
}

} // namespace gnomon::lab
