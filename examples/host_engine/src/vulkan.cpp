// SPDX-License-Identifier: Apache-2.0
#include "vulkan.h"

#include <gnomon/gnomon.h>

#include <cstring>
#include <stdexcept>

namespace host {

void check(VkResult result, const char* what)
{
    if (result < 0) throw std::runtime_error(std::string(what) + " failed with VkResult " + std::to_string(int(result)));
}

namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(
    VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT, const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    static_cast<std::vector<std::string>*>(user)->push_back(data->pMessage);
    return VK_FALSE;
}

template <class F> F load(VkInstance instance, const char* name) { return reinterpret_cast<F>(vkGetInstanceProcAddr(instance, name)); }

} // namespace

void Gpu::make_instance(bool validation, std::vector<const char*> wanted)
{
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "host_engine";
    application.apiVersion = VK_API_VERSION_1_3;

    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = keep_message;
    messenger.pUserData = &messages;
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &messenger};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    const char* layer = "VK_LAYER_KHRONOS_validation";

    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    if (validation) {
        wanted.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
    }
    info.enabledExtensionCount = uint32_t(wanted.size());
    info.ppEnabledExtensionNames = wanted.data();
    check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
    if (validation)
        check(load<PFN_vkCreateDebugUtilsMessengerEXT>(instance, "vkCreateDebugUtilsMessengerEXT")(
                  instance, &messenger, nullptr, &messenger_),
            "vkCreateDebugUtilsMessengerEXT");
}

bool Gpu::take_device(VkPhysicalDevice candidate)
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(candidate, &properties);
    const auto refuse = [&](const std::string& why) {
        refusals_ += std::string("\n") + properties.deviceName + ": " + why;
        return false;
    };
    if (properties.apiVersion < VK_API_VERSION_1_3) return refuse("no Vulkan 1.3");

    // The host's own wishes first; gnomon_require adds Gnomon's, and says what the device lacks.
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13};
    VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, &v12};
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v11, {}};
    v13.dynamicRendering = v13.synchronization2 = VK_TRUE;
    const gnomon_features features{&core.features, &v11, &v12, &v13};
    if (gnomon_require(vkGetInstanceProcAddr, instance, candidate, &features) != GNOMON_SUCCESS) return refuse(gnomon_error_message());

    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(candidate, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(candidate, &count, families.data());
    for (queue_family = 0; queue_family < count; ++queue_family) {
        constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
        VkBool32 presents = VK_TRUE;
        if (surface) check(vkGetPhysicalDeviceSurfaceSupportKHR(candidate, queue_family, surface, &presents), "asking for presentation");
        if ((families[queue_family].queueFlags & needed) == needed && presents) break;
    }
    if (queue_family == count) return refuse("no queue family draws, computes and presents");

    const float priority = 1;
    VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queues.queueFamilyIndex = queue_family;
    queues.queueCount = 1;
    queues.pQueuePriorities = &priority;
    if (surface) extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &core};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queues;
    info.enabledExtensionCount = uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (vkCreateDevice(candidate, &info, nullptr, &device) != VK_SUCCESS) return refuse("vkCreateDevice failed");
    physical = candidate;
    vkGetDeviceQueue(device, queue_family, 0, &queue);
    return true;
}

Gpu::Gpu(bool validation, const std::vector<const char*>& instance_extensions, const std::function<VkSurfaceKHR(VkInstance)>& make_surface)
{
    make_instance(validation, instance_extensions);
    if (make_surface) surface = make_surface(instance);
    uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> all(count);
    check(vkEnumeratePhysicalDevices(instance, &count, all.data()), "vkEnumeratePhysicalDevices");
    for (VkPhysicalDevice candidate : all)
        if (take_device(candidate)) break;
    if (!device) throw std::runtime_error("no device can be used:" + refusals_);
    const VkPipelineCacheCreateInfo cache{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    check(vkCreatePipelineCache(device, &cache, nullptr, &pipeline_cache), "vkCreatePipelineCache");
}

Gpu::~Gpu()
{
    if (device) {
        vkDestroyPipelineCache(device, pipeline_cache, nullptr);
        vkDestroyDevice(device, nullptr);
    }
    if (surface) vkDestroySurfaceKHR(instance, surface, nullptr);
    if (messenger_) load<PFN_vkDestroyDebugUtilsMessengerEXT>(instance, "vkDestroyDebugUtilsMessengerEXT")(instance, messenger_, nullptr);
    if (instance) vkDestroyInstance(instance, nullptr);
}

VkDeviceMemory Gpu::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) const
{
    VkPhysicalDeviceMemoryProperties kinds;
    vkGetPhysicalDeviceMemoryProperties(physical, &kinds);
    for (uint32_t kind = 0; kind < kinds.memoryTypeCount; ++kind) {
        if (!(needs.memoryTypeBits & 1u << kind) || (kinds.memoryTypes[kind].propertyFlags & wanted) != wanted) continue;
        const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, kind};
        VkDeviceMemory memory = VK_NULL_HANDLE;
        check(vkAllocateMemory(device, &info, nullptr, &memory), "vkAllocateMemory");
        return memory;
    }
    throw std::runtime_error("the device has no memory of the kind that is needed");
}

Buffer Gpu::buffer(VkDeviceSize bytes, VkBufferUsageFlags usage, const void* data) const
{
    Buffer b;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = usage;
    check(vkCreateBuffer(device, &info, nullptr, &b.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, b.buffer, &needs);
    b.memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(device, b.buffer, b.memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(device, b.memory, 0, VK_WHOLE_SIZE, 0, &b.mapped), "vkMapMemory");
    if (data) std::memcpy(b.mapped, data, bytes);
    return b;
}

Image Gpu::image(VkFormat format, VkExtent2D extent, VkSampleCountFlagBits samples, VkImageUsageFlags usage) const
{
    Image out{VK_NULL_HANDLE, VK_NULL_HANDLE, VK_NULL_HANDLE, format, extent, samples};
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = samples;
    info.usage = usage;
    check(vkCreateImage(device, &info, nullptr, &out.image), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device, out.image, &needs);
    out.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(device, out.image, out.memory, 0), "vkBindImageMemory");
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = out.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    const bool depth = (usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
    view.subresourceRange = {VkImageAspectFlags(depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), 0, 1, 0, 1};
    check(vkCreateImageView(device, &view, nullptr, &out.view), "vkCreateImageView");
    return out;
}

bool Gpu::can_be(VkFormat format, VkFormatFeatureFlags needed) const
{
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
    return (properties.optimalTilingFeatures & needed) == needed;
}

void Gpu::destroy(const Buffer& b) const
{
    vkDestroyBuffer(device, b.buffer, nullptr);
    vkFreeMemory(device, b.memory, nullptr);
}

void Gpu::destroy(const Image& i) const
{
    vkDestroyImageView(device, i.view, nullptr);
    vkDestroyImage(device, i.image, nullptr);
    vkFreeMemory(device, i.memory, nullptr);
}

} // namespace host
