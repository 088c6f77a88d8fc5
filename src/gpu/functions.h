// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"

#include <volk.h>

#include <string_view>

// Vulkan's entry points as members, loaded per instance and per device: volk's globals hold one instance only, and a program may have
// an engine's device and ours.
namespace gnomon::gpu {

struct InstanceFunctions {
    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr vkGetDeviceProcAddr = nullptr;
    PFN_vkDestroyInstance vkDestroyInstance = nullptr;
    PFN_vkEnumeratePhysicalDevices vkEnumeratePhysicalDevices = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 vkGetPhysicalDeviceProperties2 = nullptr;
    PFN_vkGetPhysicalDeviceFeatures2 vkGetPhysicalDeviceFeatures2 = nullptr;
    PFN_vkGetPhysicalDeviceFormatProperties2 vkGetPhysicalDeviceFormatProperties2 = nullptr;
    PFN_vkGetPhysicalDeviceImageFormatProperties2 vkGetPhysicalDeviceImageFormatProperties2 = nullptr;
    PFN_vkGetPhysicalDeviceMemoryProperties vkGetPhysicalDeviceMemoryProperties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties vkGetPhysicalDeviceQueueFamilyProperties = nullptr;
    PFN_vkEnumerateDeviceExtensionProperties vkEnumerateDeviceExtensionProperties = nullptr;
    PFN_vkCreateDevice vkCreateDevice = nullptr;
    PFN_vkCreateDebugUtilsMessengerEXT vkCreateDebugUtilsMessengerEXT = nullptr; ///< null without VK_EXT_debug_utils, as the next ones
    PFN_vkDestroyDebugUtilsMessengerEXT vkDestroyDebugUtilsMessengerEXT = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT vkSetDebugUtilsObjectNameEXT = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT vkCmdBeginDebugUtilsLabelEXT = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT vkCmdEndDebugUtilsLabelEXT = nullptr;
};
InstanceFunctions load_instance(PFN_vkGetInstanceProcAddr, VkInstance);
void load_device(VolkDeviceTable&, const InstanceFunctions&, VkDevice);

/// The system's Vulkan loader. Throws base::Error with a remedy where there is none.
PFN_vkGetInstanceProcAddr system_loader();

std::string_view result_name(VkResult);

/// Errors whose kind callers may act on.
struct OutOfMemory : base::Error {
    using Error::Error;
};
struct DeviceLost : base::Error {
    using Error::Error;
};

/// Throws base::Error with the call, the result and the next step; `about` says what was made or what was running.
void check(VkResult, const char* call, std::string_view about = {});

} // namespace gnomon::gpu
