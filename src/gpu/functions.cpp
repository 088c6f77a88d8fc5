// SPDX-License-Identifier: Apache-2.0
#define VOLK_IMPLEMENTATION
#include "gpu/functions.h"

namespace gnomon::gpu {

namespace {

struct DeviceLookup {
    PFN_vkGetDeviceProcAddr get;
    VkDevice device;
};

PFN_vkVoidFunction look_up(void* context, const char* name)
{
    const auto* lookup = static_cast<const DeviceLookup*>(context);
    return lookup->get(lookup->device, name);
}

} // namespace

InstanceFunctions load_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance)
{
    InstanceFunctions f;
    f.vkGetInstanceProcAddr = get;
    const auto load = [&](auto& member, const char* name) {
        member = reinterpret_cast<std::remove_reference_t<decltype(member)>>(get(instance, name));
    };
#define GNOMON_LOAD(name) load(f.name, #name)
    GNOMON_LOAD(vkGetDeviceProcAddr);
    GNOMON_LOAD(vkDestroyInstance);
    GNOMON_LOAD(vkEnumeratePhysicalDevices);
    GNOMON_LOAD(vkGetPhysicalDeviceProperties2);
    GNOMON_LOAD(vkGetPhysicalDeviceFeatures2);
    GNOMON_LOAD(vkGetPhysicalDeviceFormatProperties2);
    GNOMON_LOAD(vkGetPhysicalDeviceImageFormatProperties2);
    GNOMON_LOAD(vkGetPhysicalDeviceMemoryProperties);
    GNOMON_LOAD(vkGetPhysicalDeviceQueueFamilyProperties);
    GNOMON_LOAD(vkEnumerateDeviceExtensionProperties);
    GNOMON_LOAD(vkCreateDevice);
    GNOMON_LOAD(vkCreateDebugUtilsMessengerEXT);
    GNOMON_LOAD(vkDestroyDebugUtilsMessengerEXT);
    GNOMON_LOAD(vkSetDebugUtilsObjectNameEXT);
    GNOMON_LOAD(vkCmdBeginDebugUtilsLabelEXT);
    GNOMON_LOAD(vkCmdEndDebugUtilsLabelEXT);
#undef GNOMON_LOAD
    return f;
}

void load_device(VolkDeviceTable& table, const InstanceFunctions& instance, VkDevice device)
{
    // volkLoadDeviceTable would look up through volk's global instance; its generated loader takes any function.
    DeviceLookup lookup{instance.vkGetDeviceProcAddr, device};
    volkGenLoadDeviceTable(&table, &lookup, look_up);
}

PFN_vkGetInstanceProcAddr system_loader()
{
    static const VkResult result = volkInitialize();
    if (result != VK_SUCCESS)
        base::fail("no Vulkan loader was found on this machine; install it with a driver (Debian: apt-get install libvulkan1 "
                   "mesa-vulkan-drivers)");
    return ::vkGetInstanceProcAddr;
}

std::string_view result_name(VkResult result)
{
    switch (result) {
#define GNOMON_RESULT(name)                                                                                                                \
    case name:                                                                                                                             \
        return #name
        GNOMON_RESULT(VK_SUCCESS);
        GNOMON_RESULT(VK_NOT_READY);
        GNOMON_RESULT(VK_TIMEOUT);
        GNOMON_RESULT(VK_INCOMPLETE);
        GNOMON_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY);
        GNOMON_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        GNOMON_RESULT(VK_ERROR_INITIALIZATION_FAILED);
        GNOMON_RESULT(VK_ERROR_DEVICE_LOST);
        GNOMON_RESULT(VK_ERROR_MEMORY_MAP_FAILED);
        GNOMON_RESULT(VK_ERROR_LAYER_NOT_PRESENT);
        GNOMON_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT);
        GNOMON_RESULT(VK_ERROR_FEATURE_NOT_PRESENT);
        GNOMON_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER);
        GNOMON_RESULT(VK_ERROR_TOO_MANY_OBJECTS);
        GNOMON_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED);
        GNOMON_RESULT(VK_ERROR_FRAGMENTED_POOL);
        GNOMON_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY);
        GNOMON_RESULT(VK_ERROR_FRAGMENTATION);
        GNOMON_RESULT(VK_ERROR_INVALID_SHADER_NV);
#undef GNOMON_RESULT
    default:
        return "an unknown result";
    }
}

void check(VkResult result, const char* call, std::string_view about)
{
    if (result >= 0) return;
    const std::string subject = about.empty() ? std::string() : fmt::format(" for {}", about);
    switch (result) {
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
        throw OutOfMemory(fmt::format(
            "out of device memory: {} returned {}{}; choose a smaller --size or a smaller map", call, result_name(result), subject));
    case VK_ERROR_DEVICE_LOST:
        throw DeviceLost(
            fmt::format("the device was lost: {} returned {}{}; run these passes one by one, with --validation, to find the one at fault",
                call, result_name(result), subject));
    default:
        base::fail("{} returned {} ({}){}; run again with --validation to see what the driver was given", call, result_name(result),
            int(result), subject);
    }
}

} // namespace gnomon::gpu
