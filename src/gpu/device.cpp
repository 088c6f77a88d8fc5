// SPDX-License-Identifier: Apache-2.0
#include "gpu/device.h"

#include "gpu/features.h"
#include "gpu/recorder.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

std::string lower(std::string_view text)
{
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return out;
}

/// Real GPUs before software.
int rank(const FoundDevice& d)
{
    switch (d.properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    default:
        return d.info.software ? 0 : 1;
    }
}

FoundDevice choose(const Instance& instance, const std::string& name)
{
    std::vector<FoundDevice> found;
    std::string names;
    for (const VkPhysicalDevice physical : instance.devices()) {
        found.push_back(inspect(instance.vk, physical));
        names += (names.empty() ? "'" : ", '") + found.back().info.name + "'";
    }
    std::erase_if(
        found, [&](const FoundDevice& d) { return lower(d.info.name + " " + d.info.driver).find(lower(name)) == std::string::npos; });
    if (found.empty()) base::fail("no Vulkan device is named like '{}'; this machine has {}", name, names);
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return rank(a) > rank(b); });
    for (const auto& d : found)
        if (d.info.missing.empty()) return d;
    base::fail("{}", lacks(found.front().info));
}

VkDevice make_device(const Instance& instance, const FoundDevice& found)
{
    FeatureChain supported(found.extensions), wanted(found.extensions);
    instance.vk.vkGetPhysicalDeviceFeatures2(found.physical, &supported.core);
    choose_features(wanted, supported);
    std::vector<const char*> extensions;
    for (const auto& e : found.extensions) extensions.push_back(e.c_str());
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, *found.queue_family, 1, &priority};
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &wanted.core};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkDevice device;
    check(instance.vk.vkCreateDevice(found.physical, &info, nullptr, &device), "vkCreateDevice", found.info.name);
    return device;
}

} // namespace

Device::Device()
    : impl_(std::make_unique<Impl>(*this))
{
}
Device::~Device() = default;

std::vector<DeviceInfo> Device::enumerate()
{
    const Instance instance(false);
    std::vector<DeviceInfo> list;
    for (const VkPhysicalDevice physical : instance.devices()) list.push_back(inspect(instance.vk, physical).info);
    return list;
}

std::unique_ptr<Device> Device::open(const DeviceOptions& options)
{
    std::unique_ptr<Device> device(new Device);
    Context& c = *device->impl_;
    c.own_instance = std::make_unique<Instance>(options.validation);
    const Instance& instance = *c.own_instance;
    FoundDevice found = choose(instance, options.name);
    for (const std::string& name : options.without) {
        found.extensions.erase(name);
        found.info.ray_query &= name != VK_KHR_RAY_QUERY_EXTENSION_NAME;
        found.info.ray_tracing_pipeline &= name != VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME;
    }
    if (!instance.surface) found.extensions.erase(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    static_cast<InstanceFunctions&>(c.vk) = instance.vk;
    c.instance = instance.handle;
    c.physical = found.physical;
    c.info = found.info;
    c.handle = make_device(instance, found);
    load_device(c.vk, c.vk, c.handle);
    c.queue_family = *found.queue_family;
    c.timestamp_bits = found.timestamp_bits;
    c.vk.vkGetDeviceQueue(c.handle, c.queue_family, 0, &c.queue);
    c.names = options.validation;
    // lavapipe takes twice the time of the whole G-buffer pass for 8x (citadel, 1024x768: 334 ms against 157).
    c.anisotropy = found.anisotropy && !found.info.software;
    c.start(found.extensions);
    return device;
}

std::unique_ptr<Device> Device::adopt(const AdoptedDevice& given)
{
    std::unique_ptr<Device> device(new Device);
    Context& c = *device->impl_;
    static_cast<InstanceFunctions&>(c.vk) = load_instance(given.get_instance_proc_addr, given.instance);
    const FoundDevice found = inspect(c.vk, given.physical);
    if (!found.info.missing.empty()) base::fail("{}", lacks(found.info));
    c.instance = given.instance;
    c.physical = given.physical;
    c.handle = given.device;
    load_device(c.vk, c.vk, c.handle);
    c.queue = given.queue;
    c.queue_family = given.queue_family;
    c.timestamp_bits = found.timestamp_bits;
    c.info = found.info;
    const std::set<std::string, std::less<>> enabled(given.enabled_extensions.begin(), given.enabled_extensions.end());
    const auto has = [&](const char* extension) { return enabled.contains(std::string_view(extension)); };
    const bool accel = has(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME);
    c.info.ray_query &= accel && has(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    c.info.ray_tracing_pipeline &= accel && has(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
    c.info.mesh_shader &= has(VK_EXT_MESH_SHADER_EXTENSION_NAME);
    c.info.float_atomics &= has(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    c.info.conservative_raster &= has(VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME);
    c.info.fragment_interlock &= has(VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME);
    c.callers_cache = given.pipeline_cache;
    c.cache_file = given.cache_file;
    c.start(enabled);
    return device;
}

const DeviceInfo& Device::info() const { return impl_->info; }
VkDevice Device::handle() const { return impl_->handle; }
VkPhysicalDevice Device::physical() const { return impl_->physical; }
VkInstance Device::instance() const { return impl_->instance; }
VkQueue Device::queue() const { return impl_->queue; }
uint32_t Device::queue_family() const { return impl_->queue_family; }
const VkPhysicalDeviceLimits& Device::limits() const { return impl_->properties.limits; }
bool Device::supports(std::string_view extension) const { return impl_->extensions.contains(extension); }
VkFormatFeatureFlags2 Device::format_features(VkFormat format) const { return impl_->format_features(format); }
uint64_t Device::allocated_bytes() const { return impl_->memory->used(); }

const std::vector<std::string>& Device::validation_errors() const
{
    static const std::vector<std::string> none;
    return impl_->own_instance ? impl_->own_instance->errors : none;
}

} // namespace gnomon::gpu
