// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "lab/export_impl.h"

#include <memory>
#include <regex>

#include <spirv_cross_c.h>

namespace gnomon::lab {

namespace {

// Metal's buffers have 31 places for everything: set 0 from 0 on, these, and vertex streams from 30 down.
constexpr unsigned msl_constants = 24, msl_table = 25, msl_sizes = 26;
constexpr unsigned hlsl_groups_space = 3;

struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

SpvExecutionModel model_of(VkShaderStageFlagBits stage)
{
    if (stage == VK_SHADER_STAGE_VERTEX_BIT) return SpvExecutionModelVertex;
    return stage == VK_SHADER_STAGE_FRAGMENT_BIT ? SpvExecutionModelFragment : SpvExecutionModelGLCompute;
}

bool in_ray_pipeline(VkShaderStageFlagBits stage)
{
    return stage >= VK_SHADER_STAGE_RAYGEN_BIT_KHR && stage <= VK_SHADER_STAGE_CALLABLE_BIT_KHR;
}

class Translator {
public:
    Translator(const Words& words, spvc_backend backend)
    {
        spvc_context_s* context = nullptr;
        if (spvc_context_create(&context) != SPVC_SUCCESS) throw std::bad_alloc();
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        require(spvc_context_parse_spirv(context, words.data(), words.size(), &ir));
        require(spvc_context_create_compiler(context, backend, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler));
        require(spvc_compiler_create_compiler_options(compiler, &options_));
    }
    void require(spvc_result result) const
    {
        if (result != SPVC_SUCCESS) throw Failure(spvc_context_get_last_error_string(context_.get()));
    }
    void set(spvc_compiler_option option, unsigned value) { require(spvc_compiler_options_set_uint(options_, option, value)); }
    std::string text()
    {
        const char* out = nullptr;
        require(spvc_compiler_install_compiler_options(compiler, options_));
        require(spvc_compiler_compile(compiler, &out));
        return out;
    }
    std::span<const spvc_reflected_resource> list(spvc_resource_type type)
    {
        spvc_resources resources = nullptr;
        require(spvc_compiler_create_shader_resources(compiler, &resources));
        const spvc_reflected_resource* first = nullptr;
        size_t count = 0;
        require(spvc_resources_get_resource_list_for_type(resources, type, &first, &count));
        return {first, count};
    }

    spvc_compiler compiler = nullptr;

private:
    struct Destroy {
        void operator()(spvc_context_s* context) const { spvc_context_destroy(context); }
    };
    std::unique_ptr<spvc_context_s, Destroy> context_;
    spvc_compiler_options options_ = nullptr;
};

std::string to_glsl(const Words& words)
{
    Translator t(words, SPVC_BACKEND_GLSL);
    t.set(SPVC_COMPILER_OPTION_GLSL_VERSION, 460);
    t.set(SPVC_COMPILER_OPTION_GLSL_VULKAN_SEMANTICS, 1);
    spvc_compiler_update_active_builtins(t.compiler);
    // SPIRV-Cross leaves it out
    if (spvc_compiler_has_active_builtin(t.compiler, SpvBuiltInLayer, SpvStorageClassOutput))
        t.require(spvc_compiler_require_extension(t.compiler, "GL_ARB_shader_viewport_layer_array"));
    return t.text();
}

/// The layer that became an ordinary output, the integers that became floats, and the buffer that SPIRV-Cross makes up without a place.
std::string finish_hlsl(std::string text, const Json& resources)
{
    bool unsigned_images = false, signed_images = false;
    for (const Json& r : resources) {
        const std::string type = r["type"], name = r["name"];
        const bool wide = type.starts_with("usampler");
        if (!wide && !type.starts_with("isampler")) continue;
        const std::string floats = "<float4> ", wanted = wide ? "<uint4> " : "<int4> ", rest = name + " : register(";
        if (text.find(wanted + rest) != std::string::npos) continue; // a module without floats has none to exchange them for
        const size_t at = text.find(floats + rest);
        if (at == std::string::npos) throw Failure("the image '" + name + "' of integers is not declared where it is looked for");
        text.replace(at, floats.size(), wanted);
        (wide ? unsigned_images : signed_images) = true;
    }
    static const std::regex size_of("(uint\\d? spvTextureSize\\(\\w+)<float4>([^}]*\\}\n)");
    if (unsigned_images) text = std::regex_replace(text, size_of, "$&\n$1<uint4>$2");
    if (signed_images) text = std::regex_replace(text, size_of, "$&\n$1<int4>$2");
    static const std::regex layer("\\bint (\\w+) : TEXCOORD" + std::to_string(layer_location));
    text = std::regex_replace(text, layer, "uint $1 : SV_RenderTargetArrayIndex");
    static const std::regex vertex_info("cbuffer SPIRV_Cross_VertexInfo\\s*\\{");
    return std::regex_replace(text, vertex_info, "cbuffer SPIRV_Cross_VertexInfo : register(b0, space0)\n{");
}

std::string to_hlsl(Words words, const UsedShader& shader, const Json& reflection)
{
    uniforms_to_storage(words);
    layer_to_location(words);
    integers_to_floats(words);
    if (shader.stage == VK_SHADER_STAGE_COMPUTE_BIT) {
        uint32_t group = 1;
        for (const Json& side : reflection["local_size"]) group *= side.get<uint32_t>();
        waves_from_lanes(words, group);
    }
    Translator t(words, SPVC_BACKEND_HLSL);
    t.set(SPVC_COMPILER_OPTION_HLSL_SHADER_MODEL, reflection.value("ray_query", false) ? 65 : 60);
    t.set(SPVC_COMPILER_OPTION_HLSL_SUPPORT_NONZERO_BASE_VERTEX_BASE_INSTANCE, 1);
    t.set(SPVC_COMPILER_OPTION_FLIP_VERTEX_Y, 1);
    for (const spvc_reflected_resource& r : t.list(SPVC_RESOURCE_TYPE_STORAGE_BUFFER)) {
        const unsigned set = spvc_compiler_get_decoration(t.compiler, r.id, SpvDecorationDescriptorSet);
        const unsigned binding = spvc_compiler_get_decoration(t.compiler, r.id, SpvDecorationBinding);
        for (const Json& known : reflection["resources"])
            if (known["set"] == set && known["binding"] == binding && known["type"].get<std::string>().starts_with("uniform "))
                spvc_compiler_set_decoration(t.compiler, r.id, SpvDecorationNonWritable, 1);
    }
    if (const spvc_variable_id groups = spvc_compiler_hlsl_remap_num_workgroups_builtin(t.compiler)) {
        spvc_compiler_set_decoration(t.compiler, groups, SpvDecorationDescriptorSet, hlsl_groups_space);
        spvc_compiler_set_decoration(t.compiler, groups, SpvDecorationBinding, 0);
    }
    return finish_hlsl(t.text(), reflection["resources"]);
}

std::string to_msl(Words words, const UsedShader& shader, const Json& reflection)
{
    give_table_size(words);
    Translator t(words, SPVC_BACKEND_MSL);
    t.set(SPVC_COMPILER_OPTION_MSL_VERSION, SPVC_MAKE_MSL_VERSION(2, 4, 0));
    t.set(SPVC_COMPILER_OPTION_MSL_PLATFORM, SPVC_MSL_PLATFORM_MACOS);
    t.set(SPVC_COMPILER_OPTION_MSL_ARGUMENT_BUFFERS, 1);
    t.set(SPVC_COMPILER_OPTION_MSL_BUFFER_SIZE_BUFFER_INDEX, msl_sizes);
    t.set(SPVC_COMPILER_OPTION_FLIP_VERTEX_Y, 1);
    t.require(spvc_compiler_msl_add_discrete_descriptor_set(t.compiler, 0));
    t.require(spvc_compiler_msl_add_discrete_descriptor_set(t.compiler, 1));
    const auto place = [&](unsigned set, unsigned binding, unsigned buffer, unsigned texture, unsigned sampler) {
        const spvc_msl_resource_binding b{model_of(shader.stage), set, binding, buffer, texture, sampler};
        t.require(spvc_compiler_msl_add_resource_binding(t.compiler, &b));
    };
    for (const Json& r : reflection["resources"])
        if (r["set"] == 0) place(0, r["binding"], r["binding"], r["binding"], r["binding"]);
    place(1, 0, msl_constants, 0, 0);
    place(2, 0, 0, 0, table_size);
    place(2, SPVC_MSL_ARGUMENT_BUFFER_BINDING, msl_table, 0, 0);
    return t.text();
}

const char* no_ray_pipeline(Language language)
{
    if (language == Language::hlsl) return "SPIRV-Cross writes no HLSL for stages of ray-tracing pipelines; source/ has the GLSL";
    return "Metal has no ray-tracing pipelines, only queries inside of other shaders; source/ has the GLSL";
}

} // namespace

Language parse_language(const std::string& text)
{
    for (const Language l : {Language::glsl, Language::hlsl, Language::msl, Language::spirv})
        if (text == language_name(l)) return l;
    base::fail("there is no export to '{}'; the languages are glsl, hlsl, msl and spirv", text);
}

std::string_view language_name(Language language)
{
    constexpr std::string_view names[] = {"glsl", "hlsl", "msl", "spirv"};
    return names[size_t(language)];
}

std::string place_of(Language language, const Json& r)
{
    const unsigned set = r["set"], binding = r["binding"];
    const std::string type = r["type"];
    const bool table = set == 2, constants = set == 1, texture = type.find("sampler") != std::string::npos;
    if (language == Language::hlsl) {
        if (texture) return fmt::format("t{0}, s{0}, space{1}", binding, set);
        return fmt::format("{}{}, space{}", r.value("writes", false) ? 'u' : 't', binding, set);
    }
    if (language != Language::msl) return fmt::format("set {}, binding {}", set, binding);
    if (constants) return fmt::format("buffer({})", msl_constants);
    if (table) return fmt::format("buffer({}), an argument buffer: textures from id(0), samplers from id({}) on", msl_table, table_size);
    if (texture) return fmt::format("texture({0}), sampler({0})", binding);
    return fmt::format("{}({})", type.find("image") != std::string::npos ? "texture" : "buffer", binding);
}

Translation translate(Language language, const UsedShader& shader, std::span<const uint32_t> spirv, const Json& reflection)
{
    Words words = without_sources(spirv);
    set_defaults(words, shader.constants);
    if (language == Language::spirv) return {std::string(reinterpret_cast<const char*>(words.data()), words.size() * 4), ""};
    if (language != Language::glsl && in_ray_pipeline(shader.stage)) return {"", no_ray_pipeline(language)};
    try {
        if (language == Language::glsl) return {to_glsl(words), ""};
        return {language == Language::hlsl ? to_hlsl(words, shader, reflection) : to_msl(words, shader, reflection), ""};
    } catch (const Failure& e) {
        std::string why = e.what();
        const std::string prefix = "SPIRV-Cross threw an exception: ";
        if (why.starts_with(prefix)) why.erase(0, prefix.size());
        return {"", "SPIRV-Cross: " + why};
    }
}

} // namespace gnomon::lab
