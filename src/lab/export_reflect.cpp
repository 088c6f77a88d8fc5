// SPDX-License-Identifier: Apache-2.0
#include "lab/export_comments.h"
#include "lab/export_impl.h"

#include "gpu/reflect.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <spirv_cross_c.h>

namespace gnomon::lab {

namespace {

std::string base_name(spvc_basetype base)
{
    switch (base) {
    case SPVC_BASETYPE_BOOLEAN:
        return "bool";
    case SPVC_BASETYPE_INT32:
        return "int";
    case SPVC_BASETYPE_UINT32:
        return "uint";
    case SPVC_BASETYPE_FP32:
        return "float";
    case SPVC_BASETYPE_ACCELERATION_STRUCTURE:
        return "accelerationStructureEXT";
    default:
        throw std::logic_error("an exported shader has a type that export_reflect.cpp does not know; add it there");
    }
}

std::string_view prefix_of(spvc_basetype base) { return base == SPVC_BASETYPE_INT32 ? "i" : base == SPVC_BASETYPE_UINT32 ? "u" : ""; }

class Reflector {
public:
    Reflector(std::span<const uint32_t> spirv, const std::map<std::string, std::string>& sources, Json& types)
        : comments_(sources)
        , types_(types)
    {
        spvc_context_s* context = nullptr;
        if (spvc_context_create(&context) != SPVC_SUCCESS) throw std::bad_alloc();
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        require(spvc_context_parse_spirv(context, spirv.data(), spirv.size(), &ir));
        require(spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
        require(spvc_compiler_create_shader_resources(compiler_, &resources_));
    }

    Json specialization(std::span<const gpu::SpecConstant> given)
    {
        const spvc_specialization_constant* list = nullptr;
        size_t count = 0;
        require(spvc_compiler_get_specialization_constants(compiler_, &list, &count));
        Json out = Json::array();
        for (const auto& c : std::span(list, count)) {
            const spvc_constant constant = spvc_compiler_get_constant_handle(compiler_, c.id);
            uint32_t bits = spvc_constant_get_scalar_u32(constant, 0, 0);
            for (const gpu::SpecConstant& g : given)
                if (g.id == c.constant_id) bits = g.value;
            const std::string type
                = base_name(spvc_type_get_basetype(spvc_compiler_get_type_handle(compiler_, spvc_constant_get_type(constant))));
            out.push_back({{"id", c.constant_id}, {"name", spvc_compiler_get_name(compiler_, c.id)}, {"type", type}, {"bits", bits}});
        }
        std::sort(out.begin(), out.end(), [](const Json& a, const Json& b) { return a["id"] < b["id"]; });
        return out;
    }

    Json resources()
    {
        Json out = Json::array();
        for (const auto& r : list(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER)) out.push_back(block(r, "uniform"));
        for (const auto& r : list(SPVC_RESOURCE_TYPE_STORAGE_BUFFER)) out.push_back(block(r, "buffer"));
        for (const auto kind : {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, SPVC_RESOURCE_TYPE_STORAGE_IMAGE, SPVC_RESOURCE_TYPE_SEPARATE_IMAGE})
            for (const auto& r : list(kind)) out.push_back(image(r));
        for (const auto& r : list(SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE)) out.push_back(entry(r, "accelerationStructureEXT", r.name));
        std::sort(out.begin(), out.end(),
            [](const Json& a, const Json& b) { return std::pair(a["set"], a["binding"]) < std::pair(b["set"], b["binding"]); });
        return out;
    }

    Json variables(spvc_resource_type kind)
    {
        Json out = Json::array();
        for (const auto& r : list(kind)) {
            const spvc_type type = spvc_compiler_get_type_handle(compiler_, r.type_id);
            out.push_back({{"location", spvc_compiler_get_decoration(compiler_, r.id, SpvDecorationLocation)}, {"name", r.name},
                {"type", type_name(type)}, {"flat", bool(spvc_compiler_has_decoration(compiler_, r.id, SpvDecorationFlat))}});
        }
        std::sort(out.begin(), out.end(), [](const Json& a, const Json& b) { return a["location"] < b["location"]; });
        return out;
    }

    bool has(SpvCapability capability)
    {
        const SpvCapability* declared = nullptr;
        size_t count = 0;
        require(spvc_compiler_get_declared_capabilities(compiler_, &declared, &count));
        return std::find(declared, declared + count, capability) != declared + count;
    }

private:
    void require(spvc_result result) const
    {
        if (result != SPVC_SUCCESS) throw std::logic_error(spvc_context_get_last_error_string(context_.get()));
    }

    std::span<const spvc_reflected_resource> list(spvc_resource_type type) const
    {
        const spvc_reflected_resource* first = nullptr;
        size_t count = 0;
        require(spvc_resources_get_resource_list_for_type(resources_, type, &first, &count));
        return {first, count};
    }

    Json entry(const spvc_reflected_resource& r, const std::string& type, const std::string& name)
    {
        Json out = {{"set", spvc_compiler_get_decoration(compiler_, r.id, SpvDecorationDescriptorSet)},
            {"binding", spvc_compiler_get_decoration(compiler_, r.id, SpvDecorationBinding)}, {"name", name}, {"type", type}};
        if (const std::string meaning = comments_.of_resource(name); !meaning.empty()) out["meaning"] = meaning;
        return out;
    }

    Json image(const spvc_reflected_resource& r)
    {
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, r.type_id);
        Json out = entry(r, image_name(type), r.name);
        if (spvc_type_get_num_array_dimensions(type) > 0) out["count"] = "the scene's textures";
        if (spvc_type_get_basetype(type) != SPVC_BASETYPE_IMAGE) return out;
        out["reads"] = !spvc_compiler_has_decoration(compiler_, r.id, SpvDecorationNonReadable);
        out["writes"] = !spvc_compiler_has_decoration(compiler_, r.id, SpvDecorationNonWritable);
        return out;
    }

    std::string image_name(spvc_type type)
    {
        static const std::map<SpvDim, std::string> dimensions{
            {SpvDim1D, "1D"}, {SpvDim2D, "2D"}, {SpvDim3D, "3D"}, {SpvDimCube, "Cube"}, {SpvDimBuffer, "Buffer"}};
        const spvc_type sampled = spvc_compiler_get_type_handle(compiler_, spvc_type_get_image_sampled_type(type));
        std::string out(prefix_of(spvc_type_get_basetype(sampled)));
        out += spvc_type_get_basetype(type) == SPVC_BASETYPE_IMAGE ? "image" : "sampler";
        out += dimensions.at(spvc_type_get_image_dimension(type));
        if (spvc_type_get_image_multisampled(type)) out += "MS";
        if (spvc_type_get_image_arrayed(type)) out += "Array";
        return out + (spvc_type_get_image_is_depth(type) && out[0] == 's' ? "Shadow" : "");
    }

    Json block(const spvc_reflected_resource& r, const std::string& kind)
    {
        const std::string name = spvc_compiler_get_name(compiler_, r.base_type_id);
        Json out = entry(r, kind + " " + name, name);
        const std::string instance = spvc_compiler_get_name(compiler_, r.id);
        if (!instance.empty()) out["instance"] = instance;
        if (const std::string meaning = comments_.of(name); !meaning.empty() && !out.contains("meaning")) out["meaning"] = meaning;
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, r.base_type_id);
        size_t bytes = 0;
        require(spvc_compiler_get_declared_struct_size(compiler_, type, &bytes));
        out["bytes"] = bytes;
        out["members"] = members(type, r.base_type_id, name);
        if (kind == "uniform") return out;
        out["reads"] = !all_members(r, SpvDecorationNonReadable);
        out["writes"] = !all_members(r, SpvDecorationNonWritable);
        return out;
    }

    bool all_members(const spvc_reflected_resource& r, SpvDecoration decoration)
    {
        if (spvc_compiler_has_decoration(compiler_, r.id, decoration)) return true;
        const unsigned count = spvc_type_get_num_member_types(spvc_compiler_get_type_handle(compiler_, r.base_type_id));
        for (unsigned i = 0; i < count; ++i)
            if (!spvc_compiler_has_member_decoration(compiler_, r.base_type_id, i, decoration)) return false;
        return count > 0;
    }

    Json members(spvc_type type, SpvId id, const std::string& type_label)
    {
        Json out = Json::array();
        for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
            const spvc_type member = spvc_compiler_get_type_handle(compiler_, spvc_type_get_member_type(type, i));
            const std::string name = spvc_compiler_get_member_name(compiler_, id, i);
            unsigned offset = 0, stride = 0;
            require(spvc_compiler_type_struct_member_offset(compiler_, type, i, &offset));
            Json m = {{"name", name}, {"type", type_name(member)}, {"offset", offset}};
            if (const unsigned dimensions = spvc_type_get_num_array_dimensions(member)) {
                m["array"] = Json::array();
                for (unsigned d = dimensions; d-- > 0;) m["array"].push_back(spvc_type_get_array_dimension(member, d));
                require(spvc_compiler_type_struct_member_array_stride(compiler_, type, i, &stride));
                m["stride"] = stride;
            }
            if (const std::string meaning = comments_.of(type_label, name); !meaning.empty()) m["meaning"] = meaning;
            out.push_back(std::move(m));
        }
        return out;
    }

    /// Structs are put into `types_` on the way.
    std::string type_name(spvc_type type)
    {
        const spvc_basetype base = spvc_type_get_basetype(type);
        if (base == SPVC_BASETYPE_STRUCT) return struct_name(type);
        const unsigned rows = spvc_type_get_vector_size(type), columns = spvc_type_get_columns(type);
        if (columns > 1) return columns == rows ? fmt::format("mat{}", rows) : fmt::format("mat{}x{}", columns, rows);
        const std::string name = base_name(base);
        if (rows == 1) return name;
        return fmt::format("{}vec{}", name == "float" ? "" : name == "bool" ? "b" : name == "int" ? "i" : "u", rows);
    }

    std::string struct_name(spvc_type type)
    {
        const SpvId id = spvc_type_get_base_type_id(type);
        const spvc_type plain = spvc_compiler_get_type_handle(compiler_, id);
        std::string name = spvc_compiler_get_name(compiler_, id);
        size_t bytes = 0;
        require(spvc_compiler_get_declared_struct_size(compiler_, plain, &bytes));
        Json found = {{"bytes", bytes}};
        if (const std::string meaning = comments_.of(name); !meaning.empty()) found["meaning"] = meaning;
        found["members"] = members(plain, id, name);
        // two shaders may call different structs by one name
        const std::string own = name;
        for (int n = 2; types_.contains(name) && types_[name]["members"] != found["members"]; ++n) name = fmt::format("{}_{}", own, n);
        types_[name] = std::move(found);
        return name;
    }

    struct Destroy {
        void operator()(spvc_context_s* context) const { spvc_context_destroy(context); }
    };
    const Comments comments_;
    Json& types_;
    std::unique_ptr<spvc_context_s, Destroy> context_;
    spvc_compiler compiler_ = nullptr;
    spvc_resources resources_ = nullptr;
};

std::string_view stage_name(VkShaderStageFlagBits stage)
{
    switch (stage) {
    case VK_SHADER_STAGE_VERTEX_BIT:
        return "vertex";
    case VK_SHADER_STAGE_FRAGMENT_BIT:
        return "fragment";
    case VK_SHADER_STAGE_COMPUTE_BIT:
        return "compute";
    case VK_SHADER_STAGE_RAYGEN_BIT_KHR:
        return "ray generation";
    case VK_SHADER_STAGE_MISS_BIT_KHR:
        return "miss";
    case VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR:
        return "closest hit";
    case VK_SHADER_STAGE_ANY_HIT_BIT_KHR:
        return "any hit";
    default:
        throw std::logic_error("an exported shader is of a stage that export_reflect.cpp does not know; add it there");
    }
}

} // namespace

Json reflect_shader(
    const UsedShader& shader, std::span<const uint32_t> spirv, const std::map<std::string, std::string>& sources, Json& types)
{
    Words words = without_sources(spirv);
    set_defaults(words, shader.constants);
    Reflector r(words, sources, types);
    Json out = {{"shader", shader.name}, {"stage", stage_name(shader.stage)}, {"specialization", r.specialization(shader.constants)}};
    out["resources"] = r.resources();
    if (shader.stage == VK_SHADER_STAGE_VERTEX_BIT) out["inputs"] = r.variables(SPVC_RESOURCE_TYPE_STAGE_INPUT);
    if (shader.stage == VK_SHADER_STAGE_FRAGMENT_BIT) out["outputs"] = r.variables(SPVC_RESOURCE_TYPE_STAGE_OUTPUT);
    if (shader.stage == VK_SHADER_STAGE_COMPUTE_BIT)
        out["local_size"] = gpu::reflect({shader.name, words}, shader.stage, shader.constants).local_size;
    if (r.has(SpvCapabilityRayQueryKHR)) out["ray_query"] = true;
    return out;
}

} // namespace gnomon::lab
