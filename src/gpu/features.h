// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/functions.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace gnomon::gpu {

/// The feature structs that Gnomon asks for, chained. An extension's struct is in the chain only where the device has the extension.
/// Features are asked for one by one: the ray-tracing pipeline may come without ray queries.
struct FeatureChain {
    explicit FeatureChain(const std::set<std::string, std::less<>>& extensions);
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;

    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR accel{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR ray_query{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR ray_pipeline{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR};
    VkPhysicalDeviceMeshShaderFeaturesEXT mesh{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT};
    VkPhysicalDeviceShaderAtomicFloatFeaturesEXT atomic_float{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_FLOAT_FEATURES_EXT};
    VkPhysicalDeviceShaderAtomicFloat2FeaturesEXT atomic_float2{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_FLOAT_2_FEATURES_EXT};
    VkPhysicalDeviceFragmentShaderInterlockFeaturesEXT interlock{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_INTERLOCK_FEATURES_EXT};
    VkPhysicalDeviceFragmentShaderBarycentricFeaturesKHR barycentric{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_BARYCENTRIC_FEATURES_KHR};
};

/// A caller's own structures, in which the features that Gnomon needs, and those that it can use, are set.
struct CallersFeatures {
    VkPhysicalDeviceFeatures* core;
    VkPhysicalDeviceVulkan11Features* v11;
    VkPhysicalDeviceVulkan12Features* v12;
    VkPhysicalDeviceVulkan13Features* v13;
};
/// "", or a sentence that names what the device lacks; then nothing is set.
std::string require_features(PFN_vkGetInstanceProcAddr, VkInstance, VkPhysicalDevice, const CallersFeatures&);

struct FoundDevice {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    DeviceInfo info;
    std::set<std::string, std::less<>> extensions; ///< those that Gnomon wants and the device has
    std::optional<uint32_t> queue_family; ///< graphics, compute and transfer
    uint32_t timestamp_bits = 0;
    bool anisotropy = false;
};
/// The sentence for a device of which `missing` is not empty.
std::string lacks(const DeviceInfo&);
FoundDevice inspect(const InstanceFunctions&, VkPhysicalDevice);

/// Sets in `wanted` what Gnomon uses of `supported` (the baseline and every optional feature present).
void choose_features(FeatureChain& wanted, FeatureChain& supported);

} // namespace gnomon::gpu
