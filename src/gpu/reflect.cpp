// SPDX-License-Identifier: Apache-2.0
#include "gpu/reflect.h"

#include "base/names.h"

#include <algorithm>
#include <memory>
#include <spirv_cross_c.h>
#include <stdexcept>

#include <fmt/format.h>

namespace gnomon::gpu {

namespace {

class Reflector {
public:
    Reflector(const ShaderSource& shader, VkShaderStageFlagBits stage)
        : shader_(shader)
        , stage_(stage)
    {
        spvc_context_s* context = nullptr;
        if (spvc_context_create(&context) != SPVC_SUCCESS) throw std::bad_alloc();
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        require(spvc_context_parse_spirv(context, shader.spirv.data(), shader.spirv.size(), &ir));
        require(spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
        require(spvc_compiler_create_shader_resources(compiler_, &resources_));
    }

    Reflection read(std::span<const SpecConstant> constants)
    {
        if (stage_ == VK_SHADER_STAGE_COMPUTE_BIT) read_local_size(constants);
        read_all(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
        read_all(SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
        read_all(SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
        read_all(SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
        read_all(SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
        read_all(SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR);
        refuse(SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, "a sampler of its own; use combined ones (sampler2D)");
        refuse(SPVC_RESOURCE_TYPE_PUSH_CONSTANT, "push constants; use the constants block at set 1, binding 0");
        return std::move(out_);
    }

private:
    [[noreturn]] void wrong(const std::string& what) const
    {
        throw std::logic_error(fmt::format("shader '{}' has {}", shader_.name, what));
    }
    void require(spvc_result result) const
    {
        if (result != SPVC_SUCCESS) wrong(std::string("no SPIR-V that can be read: ") + spvc_context_get_last_error_string(context_.get()));
    }

    std::span<const spvc_reflected_resource> list(spvc_resource_type type) const
    {
        const spvc_reflected_resource* first = nullptr;
        size_t count = 0;
        require(spvc_resources_get_resource_list_for_type(resources_, type, &first, &count));
        return {first, count};
    }

    void refuse(spvc_resource_type type, const char* what) const
    {
        if (!list(type).empty()) wrong(what);
    }

    VkImageViewType view_of(spvc_type type) const
    {
        const bool array = spvc_type_get_image_arrayed(type);
        switch (spvc_type_get_image_dimension(type)) {
        case SpvDim1D:
            return array ? VK_IMAGE_VIEW_TYPE_1D_ARRAY : VK_IMAGE_VIEW_TYPE_1D;
        case SpvDim3D:
            return VK_IMAGE_VIEW_TYPE_3D;
        case SpvDimCube:
            return array ? VK_IMAGE_VIEW_TYPE_CUBE_ARRAY : VK_IMAGE_VIEW_TYPE_CUBE;
        default:
            return array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
        }
    }

    void read_all(spvc_resource_type kind, VkDescriptorType type)
    {
        for (const auto& resource : list(kind)) {
            ReflectedBinding b{};
            b.set = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationDescriptorSet);
            b.binding = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationBinding);
            b.type = type;
            b.stages = stage_;
            b.name = resource.name;
            const spvc_type handle = spvc_compiler_get_type_handle(compiler_, resource.type_id);
            b.count = 1;
            if (spvc_type_get_num_array_dimensions(handle) > 0) b.count = spvc_type_get_array_dimension(handle, 0);
            const bool image = type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE || type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                || type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
            if (image) b.view = view_of(handle);
            check_place(b, resource);
            out_.bindings.push_back(std::move(b));
        }
    }

    void check_place(const ReflectedBinding& b, const spvc_reflected_resource& resource)
    {
        if (b.set == 0) {
            if (b.count != 1)
                wrong(fmt::format("the descriptor array '{}' in set 0; use a texture array, or the texture table at set 2", b.name));
        } else if (b.set == 1 && b.binding == 0 && b.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
            size_t bytes = 0;
            require(
                spvc_compiler_get_declared_struct_size(compiler_, spvc_compiler_get_type_handle(compiler_, resource.base_type_id), &bytes));
            out_.constants_bytes = uint32_t(bytes);
        } else if (b.set != 2 || b.binding != 0 || b.type != VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER || b.count != 0) {
            wrong(fmt::format(
                "'{}' at set {}, binding {}; set 0 holds the pass's bindings, set 1 binding 0 the constants block, set 2 binding 0 "
                "`uniform sampler2D textures[]`",
                b.name, b.set, b.binding));
        }
    }

    // glslc writes LocalSizeId for Vulkan 1.3 where a size is a specialisation constant.
    void read_local_size(std::span<const SpecConstant> constants)
    {
        spvc_specialization_constant spec[3] = {};
        spvc_compiler_get_work_group_size_specialization_constants(compiler_, &spec[0], &spec[1], &spec[2]);
        for (unsigned i = 0; i < 3; ++i) {
            const unsigned literal = spvc_compiler_get_execution_mode_argument_by_index(compiler_, SpvExecutionModeLocalSize, i);
            out_.local_size[i] = std::max(literal, 1u);
            if (!spec[i].id) continue;
            out_.local_size[i] = spvc_constant_get_scalar_u32(spvc_compiler_get_constant_handle(compiler_, spec[i].id), 0, 0);
            for (const auto& c : constants)
                if (c.id == spec[i].constant_id) out_.local_size[i] = c.value;
        }
    }

    struct Destroy {
        void operator()(spvc_context_s* context) const { spvc_context_destroy(context); }
    };
    const ShaderSource& shader_;
    VkShaderStageFlagBits stage_;
    std::unique_ptr<spvc_context_s, Destroy> context_;
    spvc_compiler compiler_ = nullptr;
    spvc_resources resources_ = nullptr;
    Reflection out_;
};

} // namespace

Reflection reflect(const ShaderSource& shader, VkShaderStageFlagBits stage, std::span<const SpecConstant> constants)
{
    return Reflector(shader, stage).read(constants);
}

VkShaderStageFlagBits stage_of(std::string_view shader)
{
    constexpr std::pair<std::string_view, VkShaderStageFlagBits> ends[]
        = {{".vert", VK_SHADER_STAGE_VERTEX_BIT}, {".frag", VK_SHADER_STAGE_FRAGMENT_BIT}, {".comp", VK_SHADER_STAGE_COMPUTE_BIT},
            {".geom", VK_SHADER_STAGE_GEOMETRY_BIT}, {".task", VK_SHADER_STAGE_TASK_BIT_EXT}, {".mesh", VK_SHADER_STAGE_MESH_BIT_EXT},
            {".rgen", VK_SHADER_STAGE_RAYGEN_BIT_KHR}, {".rmiss", VK_SHADER_STAGE_MISS_BIT_KHR},
            {".rchit", VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR}, {".rahit", VK_SHADER_STAGE_ANY_HIT_BIT_KHR}};
    for (const auto& [end, stage] : ends)
        if (shader.ends_with(end)) return stage;
    throw std::logic_error(fmt::format("shader '{}' has no stage in its name; it ends with .comp, .vert, .frag ...", shader));
}

const ShaderSource& find_shader(std::string_view name)
{
    const auto all = embedded_shaders();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ShaderSource& s) { return s.name == name; });
    if (found != all.end()) return *found;
    std::vector<std::string> names;
    for (const auto& s : all) names.emplace_back(s.name);
    throw std::logic_error(base::unknown_name("shader", name, names));
}

} // namespace gnomon::gpu
