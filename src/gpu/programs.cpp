// SPDX-License-Identifier: Apache-2.0
#include "gpu/programs.h"

#include "base/file.h"
#include "base/hash.h"
#include "gpu/reflect.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

constexpr size_t digest_bytes = 32;

std::string key_of(std::string_view kind, std::initializer_list<std::string_view> shaders, std::span<const SpecConstant> constants)
{
    std::string key(kind);
    for (const auto shader : shaders) key += fmt::format(" {}", shader);
    for (const auto& c : constants) key += fmt::format(" {}={:x}", c.id, c.value);
    return key;
}

void merge(ProgramImpl& program, const Reflection& shader, std::string_view name)
{
    for (const auto& b : shader.bindings) {
        const auto same = std::find_if(program.bindings.begin(), program.bindings.end(),
            [&](const ReflectedBinding& o) { return o.set == b.set && o.binding == b.binding; });
        if (same == program.bindings.end())
            program.bindings.push_back(b);
        else if (same->type != b.type || same->view != b.view)
            throw std::logic_error(fmt::format("program '{}': '{}' declares set {}, binding {} ('{}') unlike the stage before it",
                program.name, name, b.set, b.binding, b.name));
        else
            same->stages |= b.stages;
    }
    if (shader.constants_bytes && program.constants_bytes && shader.constants_bytes != program.constants_bytes)
        throw std::logic_error(fmt::format("program '{}': the constants block has {} bytes in '{}' and {} in the stage before it",
            program.name, shader.constants_bytes, name, program.constants_bytes));
    program.constants_bytes = std::max(program.constants_bytes, shader.constants_bytes);
}

} // namespace

Programs::Programs(Context& c)
    : context_(c)
{
    load_cache();
}

Programs::~Programs()
{
    programs_.clear();
    retired_.clear();
    if (cache_ == context_.callers_cache) return;
    if (changed_ && context_.cache_file) save_cache();
    context_.vk.vkDestroyPipelineCache(context_.handle, cache_, nullptr);
}

ProgramImpl* Programs::known(const std::string& key)
{
    const auto it = programs_.find(key);
    return it == programs_.end() ? nullptr : it->second.get();
}

ProgramImpl& Programs::start(const std::string& key, std::span<const SpecConstant> constants, VkPipelineBindPoint point)
{
    auto& slot = programs_[key];
    slot = std::make_unique<ProgramImpl>(context_);
    slot->name = key.substr(key.find(' ') + 1);
    slot->constants.assign(constants.begin(), constants.end());
    slot->point = point;
    return *slot;
}

uint32_t Programs::add_stage(ProgramImpl& program, std::string_view shader, VkShaderStageFlags allowed)
{
    const auto replaced = replaced_.find(shader);
    const ShaderSource source = replaced == replaced_.end() ? find_shader(shader) : ShaderSource{shader, replaced->second};
    const VkShaderStageFlagBits stage = stage_of(shader);
    if (!(stage & allowed)) throw std::logic_error(fmt::format("shader '{}' is of the wrong stage for program '{}'", shader, program.name));
    const Reflection reflection = reflect(source, stage, program.constants);
    merge(program, reflection, shader);
    if (stage == VK_SHADER_STAGE_COMPUTE_BIT) program.local_size = reflection.local_size;
    const VkShaderModuleCreateInfo info{
        VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, source.spirv.size_bytes(), source.spirv.data()};
    VkShaderModule module;
    check(context_.vk.vkCreateShaderModule(context_.handle, &info, nullptr, &module), "vkCreateShaderModule", shader);
    context_.name(VK_OBJECT_TYPE_SHADER_MODULE, uint64_t(module), shader);
    program.stages.push_back({stage, module, std::string(shader)});
    return uint32_t(program.stages.size() - 1);
}

void Programs::finish(ProgramImpl& program)
{
    std::sort(program.bindings.begin(), program.bindings.end(),
        [](const auto& a, const auto& b) { return std::pair(a.set, a.binding) < std::pair(b.set, b.binding); });
    std::vector<VkDescriptorSetLayoutBinding> set0;
    for (const auto& b : program.bindings) {
        if (b.set == 0) set0.push_back({b.binding, b.type, 1, b.stages, nullptr});
        program.textures |= b.set == 2;
    }
    const VkDescriptorSetLayoutCreateInfo set_info{
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0, uint32_t(set0.size()), set0.data()};
    check(context_.vk.vkCreateDescriptorSetLayout(context_.handle, &set_info, nullptr, &program.set0), "vkCreateDescriptorSetLayout",
        program.name);
    const VkDescriptorSetLayout sets[] = {program.set0, context_.constants_layout, context_.table_layout};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = program.textures ? 3 : 2;
    info.pSetLayouts = sets;
    check(context_.vk.vkCreatePipelineLayout(context_.handle, &info, nullptr, &program.layout), "vkCreatePipelineLayout", program.name);
}

void Programs::replace(std::string_view shader, std::vector<uint32_t> spirv)
{
    find_shader(shader); // throws where there is none of that name
    reflect({shader, spirv}, stage_of(shader), {});
    replaced_[std::string(shader)] = std::move(spirv);
    const std::string word = " " + std::string(shader) + " ";
    for (auto it = programs_.begin(); it != programs_.end();) {
        const bool uses = (it->first + " ").find(word) != std::string::npos;
        if (uses) retired_.push_back(std::move(it->second));
        it = uses ? programs_.erase(it) : std::next(it);
    }
}

const Program& Programs::compute(std::string_view shader, std::span<const SpecConstant> constants)
{
    const std::string key = key_of("compute", {shader}, constants);
    if (const auto* found = known(key)) return *found;
    try {
        ProgramImpl& program = start(key, constants, VK_PIPELINE_BIND_POINT_COMPUTE);
        add_stage(program, shader, VK_SHADER_STAGE_COMPUTE_BIT);
        finish(program);
        return program;
    } catch (...) {
        programs_.erase(key);
        throw;
    }
}

const Program& Programs::raster(std::string_view vertex, std::string_view fragment, std::span<const SpecConstant> constants)
{
    const std::string key = key_of("raster", {vertex, fragment}, constants);
    if (const auto* found = known(key)) return *found;
    try {
        ProgramImpl& program = start(key, constants, VK_PIPELINE_BIND_POINT_GRAPHICS);
        add_stage(program, vertex, VK_SHADER_STAGE_VERTEX_BIT);
        if (!fragment.empty()) add_stage(program, fragment, VK_SHADER_STAGE_FRAGMENT_BIT);
        finish(program);
        return program;
    } catch (...) {
        programs_.erase(key);
        throw;
    }
}

const Program& Programs::ray(std::string_view raygen, std::span<const std::string_view> miss, std::span<const HitShaders> hits,
    std::span<const SpecConstant> constants)
{
    if (!context_.info.ray_tracing_pipeline)
        base::fail(
            "device '{}' has no ray-tracing pipelines, which '{}' needs; choose another device or technique", context_.info.name, raygen);
    std::string key = key_of("ray", {raygen}, constants);
    for (const auto m : miss) key += fmt::format(" miss {}", m);
    for (const auto& h : hits) key += fmt::format(" hit {} {}", h.closest_hit, h.any_hit);
    if (const auto* found = known(key)) return *found;
    try {
        ProgramImpl& program = start(key, constants, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR);
        constexpr uint32_t none = VK_SHADER_UNUSED_KHR;
        const auto general = [&](uint32_t stage) {
            program.groups.push_back({VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR, nullptr,
                VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR, stage, none, none, none, nullptr});
        };
        general(add_stage(program, raygen, VK_SHADER_STAGE_RAYGEN_BIT_KHR));
        for (const auto m : miss) general(add_stage(program, m, VK_SHADER_STAGE_MISS_BIT_KHR));
        for (const auto& h : hits) {
            const uint32_t closest = h.closest_hit.empty() ? none : add_stage(program, h.closest_hit, VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR);
            const uint32_t any = h.any_hit.empty() ? none : add_stage(program, h.any_hit, VK_SHADER_STAGE_ANY_HIT_BIT_KHR);
            program.groups.push_back({VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR, nullptr,
                VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR, none, closest, any, none, nullptr});
        }
        program.miss_count = uint32_t(miss.size());
        program.hit_count = uint32_t(hits.size());
        finish(program);
        return program;
    } catch (...) {
        programs_.erase(key);
        throw;
    }
}

std::filesystem::path Programs::cache_file() const
{
    std::string name = "pipelines-";
    for (const uint8_t byte : context_.device_uuid) name += fmt::format("{:02x}", byte);
    return base::cache_folder() / fmt::format("{}-{:08x}.bin", name, context_.properties.driverVersion);
}

// Drivers trust this data, so the file begins with its own digest: a damaged one is as good as none.
void Programs::load_cache()
{
    if (context_.callers_cache) {
        cache_ = context_.callers_cache;
        return;
    }
    std::vector<std::byte> file;
    try {
        if (context_.cache_file && std::filesystem::exists(cache_file())) file = base::read_file(cache_file(), uint64_t(256) << 20);
    } catch (const std::exception&) {
        file.clear();
    }
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    if (file.size() > digest_bytes) {
        const std::span<const std::byte> data = std::span(file).subspan(digest_bytes);
        const std::string digest = base::Hasher().bytes(data).hex();
        if (digest.size() == digest_bytes && !std::memcmp(digest.data(), file.data(), digest_bytes)) {
            info.initialDataSize = data.size();
            info.pInitialData = data.data();
        }
    }
    if (context_.vk.vkCreatePipelineCache(context_.handle, &info, nullptr, &cache_) == VK_SUCCESS) return;
    const VkPipelineCacheCreateInfo empty{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    check(context_.vk.vkCreatePipelineCache(context_.handle, &empty, nullptr, &cache_), "vkCreatePipelineCache");
}

void Programs::save_cache() const
{
    size_t size = 0;
    if (context_.vk.vkGetPipelineCacheData(context_.handle, cache_, &size, nullptr) != VK_SUCCESS || size == 0) return;
    std::vector<std::byte> file(digest_bytes + size);
    if (context_.vk.vkGetPipelineCacheData(context_.handle, cache_, &size, file.data() + digest_bytes) != VK_SUCCESS) return;
    file.resize(digest_bytes + size);
    const std::string digest = base::Hasher().bytes(std::span(file).subspan(digest_bytes)).hex();
    std::memcpy(file.data(), digest.data(), std::min(digest.size(), digest_bytes));
    try {
        base::write_file(cache_file(), file);
    } catch (const std::exception&) {
        // A full disk or a read-only home costs the next run its pipelines' time, nothing else.
    }
}

const Program& Device::compute_program(std::string_view shader, std::span<const SpecConstant> constants)
{
    return impl_->programs->compute(shader, constants);
}

const Program& Device::raster_program(std::string_view vertex, std::string_view fragment, std::span<const SpecConstant> constants)
{
    return impl_->programs->raster(vertex, fragment, constants);
}

const Program& Device::ray_program(std::string_view raygen, std::span<const std::string_view> miss, std::span<const HitShaders> hits,
    std::span<const SpecConstant> constants)
{
    return impl_->programs->ray(raygen, miss, hits, constants);
}

void Device::replace_shader(std::string_view shader, std::vector<uint32_t> spirv) { impl_->programs->replace(shader, std::move(spirv)); }

} // namespace gnomon::gpu
