// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include "gpu/programs.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::gpu {

Context::Context(Device& d)
    : device(d)
    , transients(d)
{
}

Context::~Context()
{
    if (!handle) return;
    if (queue) vk.vkDeviceWaitIdle(handle); // else the caller says when, and may have other work in flight
    for (auto& [ticket, submission] : open) recycle(std::move(submission));
    open.clear();
    deferred_.clear(); // freed with their pool
    transients.clear();
    collect();
    programs.reset();
    for (const VkDescriptorPool pool : free_pools) vk.vkDestroyDescriptorPool(handle, pool, nullptr);
    vk.vkDestroyDescriptorSetLayout(handle, constants_layout, nullptr);
    vk.vkDestroyDescriptorSetLayout(handle, table_layout, nullptr);
    for (const VkSampler s : samplers) vk.vkDestroySampler(handle, s, nullptr);
    vk.vkDestroyQueryPool(handle, timestamps, nullptr);
    vk.vkDestroyFence(handle, fence, nullptr);
    vk.vkDestroyCommandPool(handle, command_pool, nullptr);
    vk.vkDestroyCommandPool(handle, secondary_pool, nullptr);
    memory.reset();
    if (own_instance) vk.vkDestroyDevice(handle, nullptr);
}

void Context::start(const std::set<std::string, std::less<>>& enabled)
{
    extensions = enabled;
    VkPhysicalDeviceIDProperties id{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
    VkPhysicalDeviceMaintenance4Properties sizes{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES, &id};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &sizes};
    if (info.ray_tracing_pipeline) ray.pNext = id.pNext, id.pNext = &ray;
    if (info.ray_tracing_pipeline || info.ray_query) accel.pNext = id.pNext, id.pNext = &accel;
    vk.vkGetPhysicalDeviceProperties2(physical, &all);
    properties = all.properties;
    largest_buffer = sizes.maxBufferSize;
    std::copy(std::begin(id.deviceUUID), std::end(id.deviceUUID), device_uuid.begin());
    memory = std::make_unique<MemoryPool>(vk, handle, vk, physical);

    const VkCommandPoolCreateInfo pool{
        VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, queue_family};
    check(vk.vkCreateCommandPool(handle, &pool, nullptr, &command_pool), "vkCreateCommandPool");
    check(vk.vkCreateCommandPool(handle, &pool, nullptr, &secondary_pool), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo buffer{
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, command_pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    check(vk.vkAllocateCommandBuffers(handle, &buffer, &command_buffer), "vkAllocateCommandBuffers");
    const VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vk.vkCreateFence(handle, &fence_info, nullptr, &fence), "vkCreateFence");
    make_samplers();
    make_layouts();
    programs = std::make_unique<Programs>(*this);
}

void Context::make_samplers()
{
    const auto make = [&](Sampler which, VkFilter filter, VkSamplerAddressMode address, bool compare) {
        VkSamplerCreateInfo s{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
        s.magFilter = s.minFilter = filter;
        s.mipmapMode = filter == VK_FILTER_LINEAR && !compare ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
        s.addressModeU = s.addressModeV = s.addressModeW = address;
        s.maxLod = VK_LOD_CLAMP_NONE;
        s.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK;
        s.compareEnable = compare;
        s.compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
        if (which == Sampler::linear_repeat && anisotropy) {
            s.anisotropyEnable = VK_TRUE;
            s.maxAnisotropy = std::min(8.0f, properties.limits.maxSamplerAnisotropy);
        }
        check(vk.vkCreateSampler(handle, &s, nullptr, &samplers[size_t(which)]), "vkCreateSampler");
    };
    constexpr VkFilter nearest = VK_FILTER_NEAREST, linear = VK_FILTER_LINEAR;
    make(Sampler::nearest_clamp, nearest, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false);
    make(Sampler::linear_clamp, linear, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false);
    make(Sampler::nearest_repeat, nearest, VK_SAMPLER_ADDRESS_MODE_REPEAT, false);
    make(Sampler::linear_repeat, linear, VK_SAMPLER_ADDRESS_MODE_REPEAT, false);
    make(Sampler::nearest_mirror, nearest, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT, false);
    make(Sampler::linear_mirror, linear, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT, false);
    make(Sampler::compare_nearest, nearest, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER, true);
    make(Sampler::compare_linear, linear, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER, true);
}

VkSampler Context::sampler(Sampler wanted, VkFormat format) const
{
    if (!(format_features(format) & VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_FILTER_LINEAR_BIT)) {
        if (wanted == Sampler::linear_clamp) wanted = Sampler::nearest_clamp;
        if (wanted == Sampler::linear_repeat) wanted = Sampler::nearest_repeat;
        if (wanted == Sampler::linear_mirror) wanted = Sampler::nearest_mirror;
        if (wanted == Sampler::compare_linear) wanted = Sampler::compare_nearest;
    }
    return samplers[size_t(wanted)];
}

void Context::make_layouts()
{
    const VkDescriptorSetLayoutBinding constants{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_ALL, nullptr};
    const VkDescriptorSetLayoutCreateInfo constants_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0, 1, &constants};
    check(vk.vkCreateDescriptorSetLayout(handle, &constants_info, nullptr, &constants_layout), "vkCreateDescriptorSetLayout",
        "the constants");

    const auto& limits = properties.limits;
    const uint32_t most = std::min({limits.maxPerStageDescriptorSampledImages, limits.maxPerStageDescriptorSamplers,
        limits.maxPerStageResources, limits.maxDescriptorSetSampledImages, limits.maxDescriptorSetSamplers});
    table_size = std::min(4096u, most > 64 ? most - 64 : 0u); // 64 are left to set 0
    const VkDescriptorSetLayoutBinding table{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, table_size, VK_SHADER_STAGE_ALL, nullptr};
    const VkDescriptorBindingFlags flags = VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT | VK_DESCRIPTOR_BINDING_VARIABLE_DESCRIPTOR_COUNT_BIT;
    const VkDescriptorSetLayoutBindingFlagsCreateInfo flags_info{
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO, nullptr, 1, &flags};
    const VkDescriptorSetLayoutCreateInfo table_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, &flags_info, 0, 1, &table};
    check(vk.vkCreateDescriptorSetLayout(handle, &table_info, nullptr, &table_layout), "vkCreateDescriptorSetLayout", "the texture table");
}

namespace {

struct Recording {
    bool& on;
    explicit Recording(bool& flag)
        : on(flag)
    {
        on = true;
    }
    ~Recording() { on = false; }
};

} // namespace

void Context::run(std::string_view about, const std::function<void(VkCommandBuffer)>& record)
{
    if (recording_)
        throw std::logic_error(
            fmt::format("{} was asked for while a pass list is being recorded; do it before the list is submitted", about));
    if (!queue) {
        defer(about, record);
        return;
    }
    if (lost_) base::fail("the device was lost before {}; start again, with a new device", about);
    check(vk.vkResetCommandPool(handle, command_pool, 0), "vkResetCommandPool", about);
    check(vk.vkResetFences(handle, 1, &fence), "vkResetFences", about);
    const VkCommandBufferBeginInfo begin{
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    check(vk.vkBeginCommandBuffer(command_buffer, &begin), "vkBeginCommandBuffer", about);
    {
        const Recording guard(recording_);
        record(command_buffer);
    }
    // A fence makes device writes available, but only this dependency makes them visible to the mapped buffers' readers.
    const VkMemoryBarrier2 to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        VK_ACCESS_2_MEMORY_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &to_host;
    vk.vkCmdPipelineBarrier2(command_buffer, &dependency);
    check(vk.vkEndCommandBuffer(command_buffer), "vkEndCommandBuffer", about);
    const VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, command_buffer, 0};
    VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &commands;
    VkResult result = vk.vkQueueSubmit2(queue, 1, &submit, fence);
    lost_ = result == VK_ERROR_DEVICE_LOST;
    check(result, "vkQueueSubmit2", about);
    result = vk.vkWaitForFences(handle, 1, &fence, VK_TRUE, ~uint64_t(0));
    // Out of memory: the commands run all the same, and what they use may not be touched before they are through.
    if (result < 0 && result != VK_ERROR_DEVICE_LOST) result = vk.vkQueueWaitIdle(queue);
    lost_ = result < 0;
    check(result, "vkWaitForFences", about);
}

VkCommandBuffer Context::begin_secondary(std::string_view about)
{
    const VkCommandBufferAllocateInfo allocate{
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, secondary_pool, VK_COMMAND_BUFFER_LEVEL_SECONDARY, 1};
    VkCommandBuffer commands;
    check(vk.vkAllocateCommandBuffers(handle, &allocate, &commands), "vkAllocateCommandBuffers", about);
    const VkCommandBufferInheritanceInfo inherited{VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO};
    const VkCommandBufferBeginInfo begin{
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, &inherited};
    const VkResult result = vk.vkBeginCommandBuffer(commands, &begin);
    if (result != VK_SUCCESS) vk.vkFreeCommandBuffers(handle, secondary_pool, 1, &commands);
    check(result, "vkBeginCommandBuffer", about);
    return commands;
}

void Context::defer(std::string_view about, const std::function<void(VkCommandBuffer)>& record)
{
    const VkCommandBuffer commands = begin_secondary(about);
    try {
        const Recording guard(recording_);
        record(commands);
        check(vk.vkEndCommandBuffer(commands), "vkEndCommandBuffer", about);
    } catch (...) {
        vk.vkFreeCommandBuffers(handle, secondary_pool, 1, &commands);
        throw;
    }
    deferred_.push_back(commands);
}

void Context::execute(VkCommandBuffer commands, Submission& submission)
{
    submission.secondary.insert(submission.secondary.begin(), deferred_.begin(), deferred_.end());
    deferred_.clear();
    vk.vkCmdExecuteCommands(commands, uint32_t(submission.secondary.size()), submission.secondary.data());
}

void Context::release(std::function<void()> free)
{
    if (open.empty() && deferred_.empty())
        free();
    else
        garbage_.push_back({deferred_.empty() ? last_ticket : last_ticket + 1, std::move(free)});
}

void Context::retire(uint64_t ticket)
{
    const auto it = open.find(ticket);
    if (it == open.end()) return;
    Submission submission = std::move(it->second);
    open.erase(it);
    recycle(std::move(submission));
    collect();
}

void Context::collect()
{
    const uint64_t oldest = !open.empty() ? open.begin()->first : deferred_.empty() ? ~uint64_t(0) : last_ticket + 1;
    std::vector<Garbage> ripe;
    for (auto& g : garbage_)
        if (g.ticket < oldest) ripe.push_back(std::move(g));
    std::erase_if(garbage_, [&](const Garbage& g) { return g.ticket < oldest; });
    for (const auto& g : ripe) g.free();
}

void Context::recycle(Submission&& done)
{
    for (auto& image : done.images)
        if (image) transients.give(std::move(image));
    for (auto& buffer : done.buffers)
        if (buffer) transients.give(std::move(buffer));
    if (done.constants) transients.give(std::move(done.constants));
    for (const VkDescriptorPool pool : done.descriptor_pools) {
        vk.vkResetDescriptorPool(handle, pool, 0);
        free_pools.push_back(pool);
    }
    if (!done.secondary.empty()) vk.vkFreeCommandBuffers(handle, secondary_pool, uint32_t(done.secondary.size()), done.secondary.data());
    done = {};
}

void Context::name(VkObjectType type, uint64_t object, std::string_view text) const
{
    if (!names || text.empty()) return;
    const std::string copy(text);
    const VkDebugUtilsObjectNameInfoEXT named{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, type, object, copy.c_str()};
    vk.vkSetDebugUtilsObjectNameEXT(handle, &named);
}

VkFormatFeatureFlags2 Context::format_features(VkFormat format) const
{
    VkFormatProperties3 more{VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3};
    VkFormatProperties2 basic{VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2, &more};
    vk.vkGetPhysicalDeviceFormatProperties2(physical, format, &basic);
    return more.optimalTilingFeatures;
}

VkDescriptorPool Context::new_descriptor_pool() const
{
    constexpr uint32_t sets = 128;
    std::vector<VkDescriptorPoolSize> sizes = {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, sets * 6},
        {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, sets}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, sets * 3},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sets * 4}, {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, sets * 2}};
    if (info.ray_query || info.ray_tracing_pipeline) sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, sets});
    const VkDescriptorPoolCreateInfo create{
        VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, sets, uint32_t(sizes.size()), sizes.data()};
    VkDescriptorPool pool;
    check(vk.vkCreateDescriptorPool(handle, &create, nullptr, &pool), "vkCreateDescriptorPool");
    return pool;
}

VkImageMemoryBarrier2 to_vulkan(const Barrier& b, const Range& range, const Image& image)
{
    return {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, nullptr, b.src_stages, b.src_access, b.dst_stages, b.dst_access, b.old_layout,
        b.new_layout, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image.handle(),
        {aspects_of(image.desc().format), range.first_mip, range.mips, range.first_layer, range.layers}};
}

VkBufferMemoryBarrier2 to_vulkan(const Barrier& b, const Buffer& buffer)
{
    return {VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2, nullptr, b.src_stages, b.src_access, b.dst_stages, b.dst_access,
        VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, buffer.handle(), buffer.offset(), buffer.range()};
}

void Context::barrier(VkCommandBuffer commands, const Image& image, std::span<const ImageBarrier> barriers) const
{
    std::vector<VkImageMemoryBarrier2> list;
    for (const auto& b : barriers) list.push_back(to_vulkan(b.barrier, b.range, image));
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = uint32_t(list.size());
    dependency.pImageMemoryBarriers = list.data();
    if (!list.empty()) vk.vkCmdPipelineBarrier2(commands, &dependency);
}

void Context::barrier(VkCommandBuffer commands, const Buffer& buffer, const Barrier& b) const
{
    const VkBufferMemoryBarrier2 barrier = to_vulkan(b, buffer);
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.bufferMemoryBarrierCount = 1;
    dependency.pBufferMemoryBarriers = &barrier;
    if (b.needed) vk.vkCmdPipelineBarrier2(commands, &dependency);
}

} // namespace gnomon::gpu
