// SPDX-License-Identifier: Apache-2.0
#include "gpu/instance.h"

#include "base/error.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace gnomon::gpu {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr const char* install_driver = "install one (Debian: apt-get install mesa-vulkan-drivers), or correct VK_ICD_FILENAMES and "
                                       "VK_DRIVER_FILES if they are set";

// The loader itself reports ERRORs of type GENERAL (no /proc, a stray driver file), which say nothing about our calls.
VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
    const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    if (!(severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) || !(types & VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT))
        return VK_FALSE;
    auto& errors = *static_cast<std::vector<std::string>*>(user);
    if (std::find(errors.begin(), errors.end(), data->pMessage) == errors.end()) {
        errors.emplace_back(data->pMessage);
        std::fprintf(stderr, "gnomon: validation: %s\n", data->pMessage);
    }
    return VK_FALSE;
}

template <class Property, class Enumerate> std::vector<Property> all(Enumerate&& enumerate)
{
    uint32_t count = 0;
    if (enumerate(&count, nullptr) < 0) return {};
    std::vector<Property> list(count);
    if (enumerate(&count, list.data()) < 0) return {};
    list.resize(count);
    return list;
}

/// The window systems' surfaces where present, so that a viewer can open its window on this instance.
std::vector<const char*> wanted_extensions(bool validation)
{
    std::vector<const char*> wanted
        = {"VK_KHR_surface", "VK_KHR_xcb_surface", "VK_KHR_xlib_surface", "VK_KHR_wayland_surface", "VK_KHR_win32_surface"};
    if (validation) wanted.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    return wanted;
}

bool has_layer()
{
    const auto layers = all<VkLayerProperties>([](uint32_t* n, VkLayerProperties* p) { return vkEnumerateInstanceLayerProperties(n, p); });
    return std::any_of(layers.begin(), layers.end(), [](const auto& l) { return !std::strcmp(l.layerName, validation_layer); });
}

void check_created(VkResult result)
{
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        base::fail("no Vulkan driver was found on this machine (VK_ERROR_INCOMPATIBLE_DRIVER); {}", install_driver);
    check(result, "vkCreateInstance");
}

} // namespace

Instance::Instance(bool validation)
{
    const PFN_vkGetInstanceProcAddr get = system_loader();
    if (volkGetInstanceVersion() < VK_API_VERSION_1_3)
        base::fail("the Vulkan loader is older than 1.3; install a newer one (Debian 12 or later: apt-get install libvulkan1)");
    if (validation && !has_layer())
        base::fail("the validation layer {} is not installed; install it (Debian: apt-get install vulkan-validationlayers) or run without "
                   "validation",
            validation_layer);
    const auto present = all<VkExtensionProperties>(
        [](uint32_t* n, VkExtensionProperties* p) { return vkEnumerateInstanceExtensionProperties(nullptr, n, p); });
    std::vector<const char*> extensions;
    for (const char* name : wanted_extensions(validation))
        if (std::any_of(present.begin(), present.end(), [&](const auto& e) { return !std::strcmp(e.extensionName, name); }))
            extensions.push_back(name);
    surface = !extensions.empty() && !std::strcmp(extensions[0], "VK_KHR_surface");
    if (validation) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME); // the layer brings it

    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = on_message;
    messenger.pUserData = &errors;
    const VkValidationFeatureEnableEXT enable[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &messenger, 1, enable, 0, nullptr};
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = application.pEngineName = "gnomon";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pNext = validation ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = validation ? 1 : 0;
    info.ppEnabledLayerNames = &validation_layer;
    info.enabledExtensionCount = uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check_created(vkCreateInstance(&info, nullptr, &handle));
    vk = load_instance(get, handle);
    if (validation) check(vk.vkCreateDebugUtilsMessengerEXT(handle, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

Instance::~Instance()
{
    if (messenger_) vk.vkDestroyDebugUtilsMessengerEXT(handle, messenger_, nullptr);
    if (handle) vk.vkDestroyInstance(handle, nullptr);
}

std::vector<VkPhysicalDevice> Instance::devices() const
{
    auto list = all<VkPhysicalDevice>([&](uint32_t* n, VkPhysicalDevice* p) { return vk.vkEnumeratePhysicalDevices(handle, n, p); });
    if (list.empty()) base::fail("no Vulkan device was found on this machine; {}", install_driver);
    return list;
}

} // namespace gnomon::gpu
