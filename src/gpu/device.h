// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"
#include "gpu/program.h"
#include "gpu/resources.h"

#include <volk.h>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// A thin layer over Vulkan 1.3: one device, one queue, no threads. Vulkan's enums and handles stay visible.
namespace gnomon::gpu {

class PassList;

std::string baseline_text(); ///< the features that every device must have, in words

/// What was found about one physical device. `missing` names the features of the baseline that it lacks (empty = usable).
struct DeviceInfo {
    std::string name, driver; ///< driver: name and version as the driver words it
    bool software = false;
    std::string missing;
    bool ray_query = false, ray_tracing_pipeline = false, mesh_shader = false, multiview = false, float_atomics = false;
    bool conservative_raster = false, fragment_interlock = false, depth_bounds = false;
    VkSampleCountFlags samples = 0; ///< framebuffer sample counts (colour and depth)
};

struct DeviceOptions {
    std::string name; ///< part of the device's name, any case; empty = the first usable real GPU, else software
    bool validation = false; ///< VK_LAYER_KHRONOS_validation with synchronisation validation; messages are collected
    std::vector<std::string> without; ///< extensions left out although the device has them: how code for lesser devices is tested
};

/// A device that the caller owns. All handles stay the caller's; the caller enabled the baseline (gpu::baseline_text()).
struct AdoptedDevice {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue; ///< null: nothing is ever submitted or waited for; uploads and builds run at the head of the next recorded list, and
                   ///< `submit` and `read_back` are refused
    uint32_t queue_family;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    std::vector<std::string> enabled_extensions;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; ///< the caller's; null: one of our own
    bool cache_file = true; ///< pipelines are kept in a file between runs, where the cache is our own
};

/// Time of one pass on the device, by timestamps.
struct PassTime {
    std::string name;
    double ms;
};
struct Submitted {
    std::vector<PassTime> times; ///< in the order of the list
    uint64_t transient_bytes; ///< memory of the list's transients
    std::map<std::string, uint64_t> group_bytes; ///< the same by the group (PassList::group) that made them
};

/// An image that a recorded list leaves in a layout, its writes visible to whatever comes after.
struct ImageLayout {
    Image* image;
    VkImageLayout layout;
};

/// Every failed Vulkan call throws base::Error with the call's name, the result and what to do (out of memory: smaller sizes;
/// device lost: the pass list in flight).
class Device {
public:
    static std::vector<DeviceInfo> enumerate(); ///< all devices, usable or not; throws Error where there is no Vulkan at all
    static std::unique_ptr<Device> open(const DeviceOptions&);
    static std::unique_ptr<Device> adopt(const AdoptedDevice&);
    ~Device();

    const DeviceInfo& info() const;
    VkDevice handle() const;
    VkPhysicalDevice physical() const;
    VkInstance instance() const;
    VkQueue queue() const;
    uint32_t queue_family() const;
    const VkPhysicalDeviceLimits& limits() const;
    bool supports(std::string_view extension) const; ///< enabled on this device
    VkFormatFeatureFlags2 format_features(VkFormat) const; ///< optimal tiling

    Image image(const ImageDesc&);
    Image adopt_image(VkImage, const ImageDesc&, VkImageLayout); ///< the handle stays the caller's (an engine's target, a swapchain image)
    Buffer buffer(const BufferDesc&);
    /// `desc.bytes` of a buffer of the caller's, from `offset` on (a multiple of minStorageBufferOffsetAlignment): for bindings.
    Buffer adopt_buffer(VkBuffer, const BufferDesc&, uint64_t offset);
    /// Uploads through a staging buffer and waits. `texels` tightly packed.
    void upload(Image&, std::span<const std::byte> texels, uint32_t layer = 0, uint32_t mip = 0);
    void upload(Buffer&, std::span<const std::byte>, uint64_t offset = 0);
    void generate_mips(Image&); ///< linear blits
    TextureTable texture_table(std::span<const Image* const>, std::span<const Sampler>);
    TextureTable texture_table(std::span<const VkDescriptorImageInfo>); ///< of the caller's views and samplers; a null view: never read

    /// Names are as in the table of embedded shaders: path without ".glsl" ("techniques/pcss/pcss_resolve.frag"). Programs live as
    /// long as the device; the same request returns the same program. Specialisation constants by id.
    const Program& compute_program(std::string_view shader, std::span<const SpecConstant> = {});
    const Program& raster_program(
        std::string_view vertex, std::string_view fragment, std::span<const SpecConstant> = {}); ///< fragment "" = depth only
    const Program& ray_program(std::string_view raygen, std::span<const std::string_view> miss, std::span<const HitShaders> hits,
        std::span<const SpecConstant> = {});

    /// Programs asked for from now on are made of these words instead of the embedded ones; those that are there stay. Throws
    /// std::logic_error where the shader leaves the descriptor convention, and then replaces nothing.
    void replace_shader(std::string_view shader, std::vector<uint32_t> spirv);

    /// Bottom-level structures with one geometry each, and a top level over instances. Throws where unsupported.
    AccelerationStructure build_blas(const BlasDesc&);
    AccelerationStructure build_tlas(std::span<const TlasInstance>);

    /// Records, submits, waits, reads the timestamps. The list is consumed.
    Submitted submit(PassList&&);
    /// Records into a command buffer of the caller's; no submit, no wait. Transients live until `retire`, whose ticket the caller
    /// passes once that command buffer has finished. The list's images and buffers then stand as after the list: submit that command
    /// buffer before anything else here uses them.
    uint64_t record(PassList&&, VkCommandBuffer, std::span<const ImageLayout> leave = {});
    void retire(uint64_t ticket);

    /// One layer and mip as floats: colour formats by their channel count (sRGB decoded, unorm to [0,1], uint as value), depth as 1.
    base::Picture read_back(Image&, uint32_t layer = 0, uint32_t mip = 0);
    std::vector<std::byte> read_back_bytes(Image&, uint32_t layer = 0, uint32_t mip = 0); ///< the texels as they are
    std::vector<std::byte> read_back(Buffer&);

    /// Validation messages of ERROR severity and VALIDATION type so far; tests demand none.
    const std::vector<std::string>& validation_errors() const;
    uint64_t allocated_bytes() const;

private:
    Device();
    AccelerationStructure build(
        VkAccelerationStructureTypeKHR, const VkAccelerationStructureGeometryKHR&, uint32_t primitives, const std::string& name);
    struct Impl;
    std::unique_ptr<Impl> impl_;
    friend class Image;
    friend class Buffer;
    friend class AccelerationStructure;
    friend class TextureTable;
};

} // namespace gnomon::gpu
