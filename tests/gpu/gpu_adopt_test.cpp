// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "glsl_function.h"

#include "base/error.h"

namespace gnomon::gpu {

namespace {

template <class Function> Function load(const Device& d, const char* name)
{
    const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(::vkGetInstanceProcAddr(d.instance(), "vkGetDeviceProcAddr"));
    return reinterpret_cast<Function>(get(d.handle(), name));
}

/// An engine's device, made by hand as an engine would.
class EngineDevice {
public:
    EngineDevice()
    {
        if (volkInitialize() != VK_SUCCESS) throw base::Error("no loader");
        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = VK_API_VERSION_1_3;
        VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        info.pApplicationInfo = &application;
        check(vkCreateInstance(&info, nullptr, &given.instance));
        given.get_instance_proc_addr = ::vkGetInstanceProcAddr;
        uint32_t count = 1;
        call<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(given.instance, &count, &given.physical);

        VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
        VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13};
        VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, &v12};
        VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v11};
        call<PFN_vkGetPhysicalDeviceFeatures2>("vkGetPhysicalDeviceFeatures2")(given.physical, &features);
        const float priority = 1.0f;
        const VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, 0, 1, &priority};
        VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
        create.queueCreateInfoCount = 1;
        create.pQueueCreateInfos = &queue;
        check(call<PFN_vkCreateDevice>("vkCreateDevice")(given.physical, &create, nullptr, &given.device));
        call<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(given.device, 0, 0, &given.queue);
        given.queue_family = 0;
    }
    ~EngineDevice()
    {
        call<PFN_vkDestroyDevice>("vkDestroyDevice")(given.device, nullptr);
        call<PFN_vkDestroyInstance>("vkDestroyInstance")(given.instance, nullptr);
    }
    EngineDevice(const EngineDevice&) = delete;
    EngineDevice& operator=(const EngineDevice&) = delete;

    template <class Function> Function call(const char* name) const
    {
        return reinterpret_cast<Function>(::vkGetInstanceProcAddr(given.instance, name));
    }
    static void check(VkResult result)
    {
        if (result != VK_SUCCESS) throw base::Error("a Vulkan call of the engine failed");
    }
    AdoptedDevice given{};
};

std::vector<Vec4> doubled(Device& device)
{
    const std::vector<Vec4> inputs(100, Vec4{1, 2, 3, 4});
    return run_glsl_function(device, "tests/gpu/twice.comp", inputs);
}

} // namespace

class GpuAdopt : public DeviceTest { };

TEST_F(GpuAdopt, TwoDevicesInOneProcess)
{
    const EngineDevice engine;
    const std::unique_ptr<Device> adopted = Device::adopt(engine.given);
    EXPECT_EQ(adopted->handle(), engine.given.device);
    EXPECT_FALSE(adopted->info().ray_query); // its extension was not enabled
    const Vec4 expected{2, 4, 6, 8};
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(doubled(*adopted).back(), expected);
        EXPECT_EQ(doubled(device()).back(), expected);
    }
}

TEST_F(GpuAdopt, ListsRecordIntoTheCallersCommands)
{
    const EngineDevice engine;
    const std::unique_ptr<Device> adopted = Device::adopt(engine.given);
    const VkDevice handle = engine.given.device;
    VkCommandPool pool;
    const VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    EngineDevice::check(load<PFN_vkCreateCommandPool>(*adopted, "vkCreateCommandPool")(handle, &pool_info, nullptr, &pool));
    VkCommandBuffer commands;
    const VkCommandBufferAllocateInfo allocate{
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    EngineDevice::check(load<PFN_vkAllocateCommandBuffers>(*adopted, "vkAllocateCommandBuffers")(handle, &allocate, &commands));
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    EngineDevice::check(load<PFN_vkBeginCommandBuffer>(*adopted, "vkBeginCommandBuffer")(commands, &begin));

    Buffer out = adopted->buffer({16, 0, Memory::device, "out"});
    uint64_t ticket = 0, held = 0;
    {
        PassList list(*adopted);
        const BufferId numbers = list.transient(BufferDesc{1 << 20, 0, Memory::device, "numbers"});
        list.fill(numbers, 9);
        list.copy(numbers, list.import(out), 16);
        ticket = adopted->record(std::move(list), commands);
        held = adopted->allocated_bytes();
        const Buffer passing = adopted->buffer({1 << 20, 0, Memory::device, "passing"}); // freed behind the ticket
    }
    EXPECT_EQ(adopted->allocated_bytes(), held + (1 << 20));
    EngineDevice::check(load<PFN_vkEndCommandBuffer>(*adopted, "vkEndCommandBuffer")(commands));
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    EngineDevice::check(load<PFN_vkQueueSubmit>(*adopted, "vkQueueSubmit")(engine.given.queue, 1, &submit, VK_NULL_HANDLE));
    EngineDevice::check(load<PFN_vkQueueWaitIdle>(*adopted, "vkQueueWaitIdle")(engine.given.queue));
    adopted->retire(ticket);
    EXPECT_EQ(adopted->allocated_bytes(), held);
    const std::vector<std::byte> bytes = adopted->read_back(out);
    EXPECT_EQ(bytes[0], std::byte(9));
    load<PFN_vkDestroyCommandPool>(*adopted, "vkDestroyCommandPool")(handle, pool, nullptr);
}

TEST_F(GpuAdopt, ValidationErrorsAreCollected)
{
    const std::unique_ptr<Device> watched = Device::open({device().info().name, true});
    VkBufferCreateInfo wrong{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO}; // no size, no usage
    VkBuffer buffer = VK_NULL_HANDLE;
    load<PFN_vkCreateBuffer>(*watched, "vkCreateBuffer")(watched->handle(), &wrong, nullptr, &buffer);
    load<PFN_vkDestroyBuffer>(*watched, "vkDestroyBuffer")(watched->handle(), buffer, nullptr);
    EXPECT_FALSE(watched->validation_errors().empty());
}

TEST_F(GpuAdopt, EveryDeviceIsListed)
{
    const std::vector<DeviceInfo> all = Device::enumerate();
    bool found = false;
    for (const DeviceInfo& d : all) {
        EXPECT_FALSE(d.name.empty());
        found |= d.name == device().info().name && d.missing.empty();
    }
    EXPECT_TRUE(found);
    EXPECT_NE(baseline_text().find("dynamicRendering"), std::string::npos);
}

} // namespace gnomon::gpu
