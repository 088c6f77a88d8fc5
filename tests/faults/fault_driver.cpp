// SPDX-License-Identifier: Apache-2.0
#include "fault_driver.h"

#include <cstring>
#include <type_traits>
#include <utility>

namespace gnomon::tests {

namespace {

/// A Vulkan function behind the layer; one type for each, so that its wrapper finds the driver's own.
template <class Tag> struct Hook;

PFN_vkGetInstanceProcAddr next_instance = nullptr;
PFN_vkGetDeviceProcAddr next_device = nullptr;

// Functions that may fail: (name, whether it submits or waits, the maker of a handle or "").
#define GNOMON_FALLIBLE(X)                                                                                                                 \
    X(vkAllocateMemory, false, true)                                                                                                       \
    X(vkMapMemory, false, false)                                                                                                           \
    X(vkBindBufferMemory, false, false)                                                                                                    \
    X(vkBindImageMemory, false, false)                                                                                                     \
    X(vkCreateBuffer, false, true)                                                                                                         \
    X(vkCreateImage, false, true)                                                                                                          \
    X(vkCreateImageView, false, true)                                                                                                      \
    X(vkCreateSampler, false, true)                                                                                                        \
    X(vkCreateShaderModule, false, true)                                                                                                   \
    X(vkCreateDescriptorSetLayout, false, true)                                                                                            \
    X(vkCreatePipelineLayout, false, true)                                                                                                 \
    X(vkCreateDescriptorPool, false, true)                                                                                                 \
    X(vkAllocateDescriptorSets, false, false)                                                                                              \
    X(vkCreatePipelineCache, false, true)                                                                                                  \
    X(vkCreateComputePipelines, false, true)                                                                                               \
    X(vkCreateGraphicsPipelines, false, true)                                                                                              \
    X(vkCreateRayTracingPipelinesKHR, false, true)                                                                                         \
    X(vkGetRayTracingShaderGroupHandlesKHR, false, false)                                                                                  \
    X(vkCreateAccelerationStructureKHR, false, true)                                                                                       \
    X(vkCreateQueryPool, false, true)                                                                                                      \
    X(vkCreateCommandPool, false, true)                                                                                                    \
    X(vkAllocateCommandBuffers, false, false)                                                                                              \
    X(vkResetCommandPool, false, false)                                                                                                    \
    X(vkBeginCommandBuffer, false, false)                                                                                                  \
    X(vkEndCommandBuffer, false, false)                                                                                                    \
    X(vkCreateFence, false, true)                                                                                                          \
    X(vkResetFences, false, false)                                                                                                         \
    X(vkGetQueryPoolResults, true, false)                                                                                                  \
    X(vkQueueSubmit2, true, false)                                                                                                         \
    X(vkWaitForFences, true, false)                                                                                                        \
    X(vkQueueWaitIdle, true, false)                                                                                                        \
    X(vkDeviceWaitIdle, true, false)

// Functions that end a handle: (name, the maker under which it is counted). Pipelines are told apart by nothing when they end.
#define GNOMON_ENDING(X)                                                                                                                   \
    X(vkFreeMemory, "vkAllocateMemory")                                                                                                    \
    X(vkDestroyBuffer, "vkCreateBuffer")                                                                                                   \
    X(vkDestroyImage, "vkCreateImage")                                                                                                     \
    X(vkDestroyImageView, "vkCreateImageView")                                                                                             \
    X(vkDestroySampler, "vkCreateSampler")                                                                                                 \
    X(vkDestroyShaderModule, "vkCreateShaderModule")                                                                                       \
    X(vkDestroyDescriptorSetLayout, "vkCreateDescriptorSetLayout")                                                                         \
    X(vkDestroyPipelineLayout, "vkCreatePipelineLayout")                                                                                   \
    X(vkDestroyDescriptorPool, "vkCreateDescriptorPool")                                                                                   \
    X(vkDestroyPipelineCache, "vkCreatePipelineCache")                                                                                     \
    X(vkDestroyPipeline, "pipelines")                                                                                                      \
    X(vkDestroyAccelerationStructureKHR, "vkCreateAccelerationStructureKHR")                                                               \
    X(vkDestroyQueryPool, "vkCreateQueryPool")                                                                                             \
    X(vkDestroyCommandPool, "vkCreateCommandPool")                                                                                         \
    X(vkDestroyFence, "vkCreateFence")

const char* counted_as(const char* maker) { return std::strstr(maker, "Pipelines") ? "pipelines" : maker; }

/// What a failed call leaves where the handle would be; the handle is the last argument of every maker.
template <class First, class... Rest> void nothing(First&& first, Rest&&... rest)
{
    if constexpr (sizeof...(Rest) > 0)
        nothing(std::forward<Rest>(rest)...);
    else if constexpr (std::is_pointer_v<std::remove_reference_t<First>>)
        *first = {};
}

/// A lost device works no more, but the one below is alive: what it still does would be done in buffers that are about to go.
void end_work();

template <class Tag, class... A> VkResult fallible(A... a)
{
    FaultDriver& driver = FaultDriver::get();
    const VkResult given = driver.before(Tag::name, Tag::queue);
    if (given != VK_SUCCESS) {
        if constexpr (Tag::maker) nothing(a...);
        if (given == VK_ERROR_DEVICE_LOST) end_work();
        return given;
    }
    const VkResult result = Tag::next(a...);
    if (Tag::maker && result == VK_SUCCESS) driver.made(counted_as(Tag::name));
    return result;
}

template <class Function> struct Wrapped;
template <class... A> struct Wrapped<VkResult(VKAPI_PTR*)(A...)> {
    template <class Tag> static VKAPI_ATTR VkResult VKAPI_CALL call(A... a) { return fallible<Tag>(a...); }
};
template <class Handle> struct Wrapped<void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*)> {
    template <class Tag> static VKAPI_ATTR void VKAPI_CALL call(VkDevice device, Handle handle, const VkAllocationCallbacks* callbacks)
    {
        if (handle != VK_NULL_HANDLE) FaultDriver::get().destroyed(Tag::counted);
        Tag::next(device, handle, callbacks);
    }
};

#define GNOMON_TAG(function, submits, makes)                                                                                               \
    struct Tag_##function {                                                                                                                \
        static constexpr const char* name = #function;                                                                                     \
        static constexpr bool queue = submits, maker = makes;                                                                              \
        static inline PFN_##function next = nullptr;                                                                                       \
    };
GNOMON_FALLIBLE(GNOMON_TAG)
#undef GNOMON_TAG
#define GNOMON_TAG(function, made_by)                                                                                                      \
    struct Tag_##function {                                                                                                                \
        static constexpr const char* counted = made_by;                                                                                    \
        static inline PFN_##function next = nullptr;                                                                                       \
    };
GNOMON_ENDING(GNOMON_TAG)
#undef GNOMON_TAG

VkDevice device_below = VK_NULL_HANDLE;
void end_work() { Tag_vkDeviceWaitIdle::next(device_below); }

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL look_up_device(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction driver = next_device(device, name);
    device_below = device;
    if (!driver) return nullptr;
#define GNOMON_WRAP(function, ...)                                                                                                         \
    if (!std::strcmp(name, #function)) {                                                                                                   \
        Tag_##function::next = reinterpret_cast<PFN_##function>(driver);                                                                   \
        return reinterpret_cast<PFN_vkVoidFunction>(&Wrapped<PFN_##function>::template call<Tag_##function>);                              \
    }
    GNOMON_FALLIBLE(GNOMON_WRAP)
    GNOMON_ENDING(GNOMON_WRAP)
#undef GNOMON_WRAP
    return driver;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL look_up_instance(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkGetDeviceProcAddr") != 0) return next_instance(instance, name);
    next_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(next_instance(instance, name));
    return reinterpret_cast<PFN_vkVoidFunction>(look_up_device);
}

} // namespace

FaultDriver& FaultDriver::get()
{
    static FaultDriver driver;
    return driver;
}

void FaultDriver::arm(const Fault& fault)
{
    fault_ = fault;
    calls_ = 0;
    lost_ = false;
    failed_.clear();
}

VkResult FaultDriver::before(const char* name, bool queue)
{
    if (lost_ && queue) return VK_ERROR_DEVICE_LOST;
    if (fault_.among == Fault::Among::queue && !queue) return VK_SUCCESS;
    const uint64_t call = calls_++;
    if (fault_.among == Fault::Among::none || call != fault_.at) return VK_SUCCESS;
    failed_ = name;
    lost_ = fault_.result == VK_ERROR_DEVICE_LOST;
    return fault_.result;
}

int64_t FaultDriver::live() const
{
    int64_t sum = 0;
    for (const auto& [name, count] : live_) sum += count;
    return sum;
}

std::string FaultDriver::living() const
{
    std::string text;
    for (const auto& [name, count] : live_)
        if (count != 0) text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
    return text;
}

void FaultDriver::forget() { live_.clear(); }

std::unique_ptr<gpu::Device> adopt_with_faults(const gpu::Device& below)
{
    next_instance = ::vkGetInstanceProcAddr;
    gpu::AdoptedDevice given{below.instance(), below.physical(), below.handle(), below.queue(), below.queue_family(), look_up_instance, {}};
    for (const char* name : {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
             VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, VK_EXT_MESH_SHADER_EXTENSION_NAME,
             VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME, VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME})
        if (below.supports(name)) given.enabled_extensions.emplace_back(name);
    return gpu::Device::adopt(given);
}

} // namespace gnomon::tests
