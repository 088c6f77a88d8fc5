// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "gpu/barriers.h"
#include "gpu/device.h"
#include "gpu/instance.h"
#include "gpu/memory.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

// What stands behind Device: shared by the files of this folder, seen by no one else.
namespace gnomon::gpu {

struct Functions : VolkDeviceTable, InstanceFunctions { };

class Programs;

/// Images and buffers of finished lists, by what they are, for the next list.
class TransientPool {
public:
    explicit TransientPool(Device& device)
        : device_(device)
    {
    }
    Image take(const ImageDesc&);
    Buffer take(const BufferDesc&);
    void give(Image&&);
    void give(Buffer&&);
    void age(); ///< once a submission: what was not taken for sixteen of them is freed
    void clear();

private:
    template <class T> struct Free {
        T resource;
        uint64_t since;
    };
    Device& device_;
    uint64_t now_ = 0;
    std::vector<Free<Image>> images_;
    std::vector<Free<Buffer>> buffers_;
};

/// What one recorded list holds until it has run.
struct Submission {
    std::vector<Image> images; ///< transients, by their place among the list's transients
    std::vector<Buffer> buffers;
    Buffer constants;
    std::vector<VkDescriptorPool> descriptor_pools;
    std::vector<VkCommandBuffer> secondary; ///< of a list recorded for a caller
};

struct Context {
    explicit Context(Device&);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    void start(const std::set<std::string, std::less<>>& enabled); ///< after the device and its functions are there

    /// Records into the one command buffer, submits and waits. `about` names the work, for a lost device. Where it throws, the device has
    /// done none of it, or is lost: `record` leaves states of images and buffers alone, and callers set them afterwards.
    /// Without a queue: records for the head of the next list.
    void run(std::string_view about, const std::function<void(VkCommandBuffer)>&);
    VkCommandBuffer begin_secondary(std::string_view about);
    /// Puts what was deferred, then the submission's own, into the caller's commands.
    void execute(VkCommandBuffer, Submission&);
    /// Runs now where nothing recorded for a caller is in flight, else once every open ticket has been retired.
    void release(std::function<void()>);
    void retire(uint64_t ticket);
    void name(VkObjectType, uint64_t handle, std::string_view) const;
    VkFormatFeatureFlags2 format_features(VkFormat) const;
    /// The sampler that the format can be read with: linear ones fall back to nearest where the format has no linear filter.
    VkSampler sampler(Sampler, VkFormat) const;
    void barrier(VkCommandBuffer, const Image&, std::span<const ImageBarrier>) const;
    void barrier(VkCommandBuffer, const Buffer&, const Barrier&) const;
    VkDescriptorPool new_descriptor_pool() const;
    void recycle(Submission&&);

    Device& device;
    std::unique_ptr<Instance> own_instance; ///< null: adopted
    Functions vk{};
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice handle = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queue_family = 0, timestamp_bits = 0, table_size = 0;
    bool names = false; ///< validation is on: objects and passes are named
    DeviceInfo info;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR ray{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR};
    VkPhysicalDeviceAccelerationStructurePropertiesKHR accel{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
    uint64_t largest_buffer = 0;
    std::array<uint8_t, VK_UUID_SIZE> device_uuid{};
    std::set<std::string, std::less<>> extensions;
    bool anisotropy = false;
    VkPipelineCache callers_cache = VK_NULL_HANDLE;
    bool cache_file = true;

    std::unique_ptr<MemoryPool> memory;
    std::array<VkSampler, 8> samplers{};
    VkCommandPool command_pool = VK_NULL_HANDLE, secondary_pool = VK_NULL_HANDLE; ///< the first is reset as a whole
    VkCommandBuffer command_buffer = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    VkQueryPool timestamps = VK_NULL_HANDLE;
    uint32_t timestamp_count = 0;
    VkDescriptorSetLayout constants_layout = VK_NULL_HANDLE, table_layout = VK_NULL_HANDLE;
    std::vector<VkDescriptorPool> free_pools;
    TransientPool transients;
    std::unique_ptr<Programs> programs;

    uint64_t last_ticket = 0;
    std::map<uint64_t, Submission> open; ///< recorded for a caller, not yet retired

private:
    void make_samplers();
    void make_layouts();
    void collect();
    void defer(std::string_view about, const std::function<void(VkCommandBuffer)>&);

    struct Garbage {
        uint64_t ticket;
        std::function<void()> free;
    };
    std::vector<Garbage> garbage_;
    std::vector<VkCommandBuffer> deferred_; ///< secondary ones, for the head of the next recorded list
    bool lost_ = false; ///< nothing can be submitted any more
    bool recording_ = false; ///< a draw function that uploads would end the list's own command buffer
};

struct Device::Impl : Context {
    using Context::Context;
};

// How the texels of a format are made; see formats.cpp.
enum class Numeric : uint8_t { unorm, snorm, srgb, sfloat, uint, sint };
struct FormatInfo {
    VkFormat format;
    const char* name;
    uint8_t channels, channel_bytes; ///< channel_bytes 0: packed
    Numeric numeric;
};
const FormatInfo& format_info(VkFormat);
VkImageAspectFlags aspects_of(VkFormat); ///< all
VkImageAspectFlags main_aspect(VkFormat); ///< colour or depth
bool is_integer(VkFormat);
base::Picture to_picture(VkFormat, Size, std::span<const std::byte>);
VkImageMemoryBarrier2 to_vulkan(const Barrier&, const Range&, const Image&);
VkBufferMemoryBarrier2 to_vulkan(const Barrier&, const Buffer&);
inline Size mip_size(Size s, uint32_t mip) { return {std::max(s.width >> mip, 1), std::max(s.height >> mip, 1)}; }

} // namespace gnomon::gpu
