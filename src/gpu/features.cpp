// SPDX-License-Identifier: Apache-2.0
#include "gpu/features.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon::gpu {

namespace {

struct Feature {
    const char* name;
    VkBool32& (*at)(FeatureChain&);
};
#define CORE(name)                                                                                                                         \
    Feature                                                                                                                                \
    {                                                                                                                                      \
#name, [](FeatureChain & c) -> VkBool32& { return c.core.features.name; }                                                          \
    }
#define IN(part, name)                                                                                                                     \
    Feature                                                                                                                                \
    {                                                                                                                                      \
#name, [](FeatureChain & c) -> VkBool32& { return c.part.name; }                                                                   \
    }

// imageCubeArray: point lights' maps; multiDrawIndirect, drawIndirectFirstInstance: GPU-driven casters; shaderOutputLayer: one pass for
// all cascades; geometryShader: gl_PrimitiveID in fragments.
constexpr std::array baseline = {CORE(depthClamp), CORE(depthBiasClamp), CORE(multiViewport), CORE(imageCubeArray), CORE(independentBlend),
    CORE(drawIndirectFirstInstance), CORE(multiDrawIndirect), CORE(fragmentStoresAndAtomics), CORE(geometryShader),
    CORE(fullDrawIndexUint32), CORE(shaderSampledImageArrayDynamicIndexing), CORE(shaderImageGatherExtended),
    CORE(shaderStorageImageExtendedFormats), CORE(shaderStorageImageWriteWithoutFormat), IN(v11, shaderDrawParameters),
    IN(v12, timelineSemaphore), IN(v12, bufferDeviceAddress), IN(v12, hostQueryReset), IN(v12, scalarBlockLayout),
    IN(v12, shaderOutputLayer), IN(v12, descriptorIndexing), IN(v12, shaderSampledImageArrayNonUniformIndexing),
    IN(v12, runtimeDescriptorArray), IN(v12, descriptorBindingPartiallyBound), IN(v12, descriptorBindingVariableDescriptorCount),
    IN(v12, uniformBufferStandardLayout), IN(v13, dynamicRendering), IN(v13, synchronization2), IN(v13, maintenance4),
    IN(v13, shaderDemoteToHelperInvocation), IN(v13, shaderTerminateInvocation)};

constexpr std::array optional = {CORE(samplerAnisotropy), CORE(shaderInt64), CORE(shaderFloat64), CORE(shaderInt16), CORE(fillModeNonSolid),
    CORE(wideLines), CORE(depthBounds), CORE(sampleRateShading), CORE(dualSrcBlend), CORE(tessellationShader),
    CORE(vertexPipelineStoresAndAtomics), CORE(shaderStorageImageMultisample), CORE(shaderStorageImageReadWithoutFormat),
    CORE(shaderClipDistance), CORE(shaderCullDistance), CORE(shaderStorageImageArrayDynamicIndexing),
    CORE(shaderStorageBufferArrayDynamicIndexing), CORE(shaderUniformBufferArrayDynamicIndexing), IN(v11, multiview),
    IN(v11, storageBuffer16BitAccess), IN(v12, shaderFloat16), IN(v12, shaderInt8), IN(v12, storageBuffer8BitAccess),
    IN(v12, shaderBufferInt64Atomics), IN(v12, drawIndirectCount), IN(v12, shaderOutputViewportIndex), IN(v12, samplerFilterMinmax),
    IN(v12, shaderSubgroupExtendedTypes), IN(v12, vulkanMemoryModel), IN(v12, vulkanMemoryModelDeviceScope), IN(v13, subgroupSizeControl),
    IN(v13, computeFullSubgroups), IN(accel, accelerationStructure), IN(ray_query, rayQuery), IN(ray_pipeline, rayTracingPipeline),
    IN(ray_pipeline, rayTraversalPrimitiveCulling), IN(mesh, taskShader), IN(mesh, meshShader),
    IN(atomic_float, shaderBufferFloat32Atomics), IN(atomic_float, shaderBufferFloat32AtomicAdd),
    IN(atomic_float, shaderSharedFloat32Atomics), IN(atomic_float, shaderSharedFloat32AtomicAdd),
    IN(atomic_float, shaderImageFloat32Atomics), IN(atomic_float, shaderImageFloat32AtomicAdd),
    IN(atomic_float2, shaderBufferFloat32AtomicMinMax), IN(atomic_float2, shaderSharedFloat32AtomicMinMax),
    IN(atomic_float2, shaderImageFloat32AtomicMinMax), IN(interlock, fragmentShaderPixelInterlock),
    IN(interlock, fragmentShaderSampleInterlock), IN(barycentric, fragmentShaderBarycentric)};
#undef CORE
#undef IN

constexpr std::array wanted_extensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
    VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, VK_EXT_MESH_SHADER_EXTENSION_NAME,
    VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME, VK_EXT_SHADER_ATOMIC_FLOAT_2_EXTENSION_NAME, VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME,
    VK_KHR_FRAGMENT_SHADER_BARYCENTRIC_EXTENSION_NAME, VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME, VK_KHR_SWAPCHAIN_EXTENSION_NAME};

void inspect_queues(const InstanceFunctions& vk, FoundDevice& found)
{
    uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(found.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(found.physical, &count, families.data());
    for (uint32_t i = 0; i < count && !found.queue_family; ++i) {
        constexpr VkQueueFlags both = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
        if ((families[i].queueFlags & both) != both) continue;
        found.queue_family = i;
        found.timestamp_bits = families[i].timestampValidBits;
    }
}

bool has_format(const InstanceFunctions& vk, VkPhysicalDevice physical, VkFormat format, VkFormatFeatureFlags features)
{
    VkFormatProperties2 properties{VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2};
    vk.vkGetPhysicalDeviceFormatProperties2(physical, format, &properties);
    return (properties.formatProperties.optimalTilingFeatures & features) == features;
}

/// What beyond feature bits the baseline asks for.
std::vector<std::string> missing_beside_features(
    const InstanceFunctions& vk, const FoundDevice& found, const VkPhysicalDeviceVulkan11Properties& v11)
{
    std::vector<std::string> missing;
    if (!found.queue_family) missing.push_back("a queue with graphics and compute");
    if (found.timestamp_bits == 0) missing.push_back("timestamps");
    constexpr VkSubgroupFeatureFlags subgroup = VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
    if ((v11.subgroupSupportedOperations & subgroup) != subgroup || !(v11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT))
        missing.push_back("subgroup ballot and arithmetic in compute");
    constexpr VkFormatFeatureFlags depth = VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    if (!has_format(vk, found.physical, VK_FORMAT_D32_SFLOAT, depth)) missing.push_back("the depth format D32_SFLOAT");
    if (!has_format(vk, found.physical, VK_FORMAT_D32_SFLOAT_S8_UINT, depth)
        && !has_format(vk, found.physical, VK_FORMAT_D24_UNORM_S8_UINT, depth))
        missing.push_back("a depth format with stencil");
    return missing;
}

std::string join(const std::vector<std::string>& list)
{
    std::string text;
    for (const auto& item : list) text += (text.empty() ? "" : ", ") + item;
    return text;
}

} // namespace

FeatureChain::FeatureChain(const std::set<std::string, std::less<>>& extensions)
{
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
    const auto add = [this](const auto& has, const char* name, auto& part) {
        if (!has.contains(std::string_view(name))) return;
        part.pNext = v13.pNext;
        v13.pNext = &part;
    };
    add(extensions, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, accel);
    add(extensions, VK_KHR_RAY_QUERY_EXTENSION_NAME, ray_query);
    add(extensions, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, ray_pipeline);
    add(extensions, VK_EXT_MESH_SHADER_EXTENSION_NAME, mesh);
    add(extensions, VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME, atomic_float);
    add(extensions, VK_EXT_SHADER_ATOMIC_FLOAT_2_EXTENSION_NAME, atomic_float2);
    add(extensions, VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME, interlock);
    add(extensions, VK_KHR_FRAGMENT_SHADER_BARYCENTRIC_EXTENSION_NAME, barycentric);
}

void choose_features(FeatureChain& wanted, FeatureChain& supported)
{
    for (const auto& feature : baseline) feature.at(wanted) = feature.at(supported);
    for (const auto& feature : optional) feature.at(wanted) = feature.at(supported);
}

std::string baseline_text()
{
    std::string text = "Vulkan 1.3 with";
    for (const auto& feature : baseline) text += std::string(text.back() == 'h' ? " " : ", ") + feature.name;
    return text + ", subgroup ballot and arithmetic in compute, timestamps, D32_SFLOAT and a depth format with stencil";
}

std::string lacks(const DeviceInfo& info)
{
    return fmt::format("device '{}' ({}) lacks what Gnomon needs: {}; {}", info.name, info.driver, info.missing,
        info.software ? "install Mesa 25 or later (Debian 12: from bookworm-backports)"
                      : "update its driver, or choose another with --device");
}

std::string require_features(PFN_vkGetInstanceProcAddr get, VkInstance instance, VkPhysicalDevice physical, const CallersFeatures& callers)
{
    const InstanceFunctions vk = load_instance(get, instance);
    const FoundDevice found = inspect(vk, physical);
    if (!found.info.missing.empty()) return lacks(found.info);
    FeatureChain supported({}), wanted({}), own({});
    vk.vkGetPhysicalDeviceFeatures2(physical, &supported.core);
    choose_features(wanted, supported);
    own.core.features = *callers.core, own.v11 = *callers.v11, own.v12 = *callers.v12, own.v13 = *callers.v13;
    const auto add = [&](const Feature& feature) { feature.at(own) = feature.at(own) || feature.at(wanted); };
    for (const auto& feature : baseline) add(feature);
    for (const auto& feature : optional) add(feature);
    *callers.core = own.core.features, *callers.v11 = own.v11, *callers.v12 = own.v12, *callers.v13 = own.v13;
    return {};
}

FoundDevice inspect(const InstanceFunctions& vk, VkPhysicalDevice physical)
{
    FoundDevice found;
    found.physical = physical;
    VkPhysicalDeviceVulkan12Properties v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceVulkan11Properties v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES, &v12};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &v11};
    vk.vkGetPhysicalDeviceProperties2(physical, &properties);
    found.properties = properties.properties;
    const auto& limits = found.properties.limits;
    DeviceInfo& info = found.info;
    info.name = found.properties.deviceName;
    info.driver = std::string(v12.driverName) + " " + v12.driverInfo;
    info.software = found.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    info.samples = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    if (found.properties.apiVersion < VK_API_VERSION_1_3) {
        info.missing = "Vulkan 1.3";
        return found;
    }
    inspect_queues(vk, found);
    uint32_t count = 0;
    vk.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> present(count);
    vk.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, present.data());
    for (const char* name : wanted_extensions)
        if (std::any_of(present.begin(), present.end(), [&](const auto& e) { return !std::strcmp(e.extensionName, name); }))
            found.extensions.emplace(name);

    FeatureChain supported(found.extensions);
    vk.vkGetPhysicalDeviceFeatures2(physical, &supported.core);
    std::vector<std::string> missing = missing_beside_features(vk, found, v11);
    for (const auto& feature : baseline)
        if (!feature.at(supported)) missing.push_back(feature.name);
    info.missing = join(missing);
    found.anisotropy = supported.core.features.samplerAnisotropy;
    info.ray_query = supported.accel.accelerationStructure && supported.ray_query.rayQuery;
    info.ray_tracing_pipeline = supported.accel.accelerationStructure && supported.ray_pipeline.rayTracingPipeline;
    info.mesh_shader = supported.mesh.meshShader && supported.mesh.taskShader;
    info.multiview = supported.v11.multiview;
    info.float_atomics = supported.atomic_float.shaderBufferFloat32AtomicAdd;
    info.conservative_raster = found.extensions.contains(VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME);
    info.fragment_interlock = supported.interlock.fragmentShaderPixelInterlock;
    info.depth_bounds = supported.core.features.depthBounds;
    return found;
}

} // namespace gnomon::gpu
