// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"

#include <volk.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

// A list of passes that run in the order written. Barriers and layouts come from the declared uses, by one table (barriers.h);
// each pass is named, timed and counted in bytes. It is not a graph: nothing is reordered, culled or aliased, so that what is
// measured is what was written.
namespace gnomon::gpu {

struct ImageId {
    uint32_t index = ~0u;
    bool operator==(const ImageId&) const = default;
    explicit operator bool() const { return index != ~0u; }
};
struct BufferId {
    uint32_t index = ~0u;
    bool operator==(const BufferId&) const = default;
    explicit operator bool() const { return index != ~0u; }
};

/// How a pass uses an image or a buffer.
enum class Use : uint8_t {
    sample, ///< sampled image (also texelFetch)
    load, ///< storage image or buffer, read only
    store, ///< storage image or buffer, written (old content not needed)
    update, ///< storage image or buffer, read and written (atomics)
    uniform, ///< uniform buffer
    copy_from,
    copy_to,
    color,
    depth,
    depth_test, ///< attachments; made by RasterPass
    vertex,
    index,
    indirect, ///< buffers
    trace, ///< acceleration structure input buffers
};

/// One entry of set 0.
struct Binding {
    ImageId image{};
    BufferId buffer{};
    const AccelerationStructure* accel = nullptr;
    Use use = Use::sample;
    Sampler sampler = Sampler::nearest_clamp;
    VkImageViewType view = VK_IMAGE_VIEW_TYPE_MAX_ENUM; ///< default: 2D for one layer, 2D array for more
    uint32_t first_layer = 0, layer_count = VK_REMAINING_ARRAY_LAYERS, first_mip = 0, mip_count = VK_REMAINING_MIP_LEVELS;
    VkImageAspectFlags aspect = 0; ///< default: colour or depth by the format

    Binding(ImageId i, Use u, Sampler s = Sampler::nearest_clamp)
        : image(i)
        , use(u)
        , sampler(s)
    {
    }
    Binding(BufferId b, Use u)
        : buffer(b)
        , use(u)
    {
    }
    Binding(const AccelerationStructure& a)
        : accel(&a)
        , use(Use::load)
    {
    }
    Binding& layers(uint32_t first, uint32_t count, VkImageViewType type = VK_IMAGE_VIEW_TYPE_MAX_ENUM)
    {
        first_layer = first, layer_count = count, view = type;
        return *this;
    }
    Binding& mips(uint32_t first, uint32_t count)
    {
        first_mip = first, mip_count = count;
        return *this;
    }
    Binding& as(VkImageViewType type)
    {
        view = type;
        return *this;
    }
};

/// Bytes of a constants struct (scalar layout = the C++ layout of 4-byte members).
struct Constants {
    /// Part of them that an earlier pass has written into a buffer.
    struct Patch {
        BufferId source;
        uint32_t source_offset, offset, bytes;
    };
    std::vector<std::byte> bytes;
    std::vector<Patch> patches{}; ///< copied over `bytes` on the device before the pass; multiples of 4
    Constants() = default;
    template <class T>
    requires std::is_trivially_copyable_v<T> Constants(const T& v)
        : bytes(reinterpret_cast<const std::byte*>(&v), reinterpret_cast<const std::byte*>(&v) + sizeof(T))
    {
    }
};

struct Threads {
    uint32_t x = 1, y = 1, z = 1;
};

struct ComputePass {
    std::string name;
    const Program* program = nullptr;
    std::vector<Binding> bindings;
    Constants constants;
    Threads threads; ///< rounded up to groups
    const TextureTable* textures = nullptr;
    BufferId indirect{}; ///< VkDispatchIndirectCommand (groups) instead of `threads`
    uint64_t indirect_offset = 0;
};

struct RayPass {
    std::string name;
    const Program* program = nullptr;
    std::vector<Binding> bindings;
    Constants constants;
    Threads threads;
    const TextureTable* textures = nullptr;
};

enum class Load : uint8_t { clear, keep, discard };

struct ColorTarget {
    ImageId image{}; ///< invalid = attachment left out; the shader's output is dropped
    Load load = Load::clear;
    VkClearColorValue clear{};
    uint32_t layer = 0, mip = 0;
    std::optional<VkPipelineColorBlendAttachmentState> blend{};
    ImageId resolve{}; ///< multisampled targets: average into this image
};
struct DepthTarget {
    ImageId image{};
    Load load = Load::clear;
    float clear = 0.0f; ///< reversed depth: 0 = nothing there
    uint32_t clear_stencil = 0;
    bool write = true, store = true;
    VkCompareOp compare = VK_COMPARE_OP_GREATER;
    uint32_t layer = 0;
    bool stencil = false;
    VkStencilOpState front{}, back{};
};

struct VertexStream { ///< one vertex buffer binding
    uint32_t stride;
    std::vector<VkVertexInputAttributeDescription> attributes; ///< .binding is overwritten with the stream's place
    bool operator==(const VertexStream&) const;
};

/// Draw calls inside one raster pass. Valid only during `draw`.
class Encoder {
public:
    virtual ~Encoder() = default;
    virtual void vertex_buffer(uint32_t stream, const Buffer&, uint64_t offset = 0) = 0;
    virtual void index_buffer(const Buffer&, uint64_t offset = 0) = 0; ///< uint32
    virtual void vertex_buffer(uint32_t stream, BufferId, uint64_t offset = 0) = 0; ///< of this list; the pass names it in `buffers`
    virtual void index_buffer(BufferId, uint64_t offset = 0) = 0;
    virtual void cull(VkCullModeFlags) = 0; ///< dynamic; the pass's `cull` at first
    virtual void depth_bias(float constant, float clamp, float slope) = 0; ///< dynamic; 0 at first
    virtual void scissor(int x, int y, uint32_t width, uint32_t height) = 0;
    virtual void viewport(float x, float y, float width, float height) = 0;
    virtual void draw(uint32_t vertices, uint32_t instances = 1, uint32_t first_vertex = 0, uint32_t first_instance = 0) = 0;
    virtual void draw_indexed(uint32_t indices, uint32_t instances, uint32_t first_index, int32_t vertex_offset, uint32_t first_instance)
        = 0;
    virtual void draw_indexed_indirect(BufferId, uint64_t offset, uint32_t count, uint32_t stride) = 0;
    virtual void draw_indirect(BufferId, uint64_t offset, uint32_t count, uint32_t stride) = 0;
    virtual void program(const Program&)
        = 0; ///< another program with the same set 0 and constants, in the same pass (masked beside opaque)
    virtual VkCommandBuffer handle() = 0;
};

struct RasterPass {
    std::string name;
    const Program* program = nullptr;
    std::vector<Binding> bindings;
    Constants constants;
    const TextureTable* textures = nullptr;
    std::vector<ColorTarget> colors;
    std::optional<DepthTarget> depth;
    Size size{}; ///< render area; default: the first attachment's (mip) size
    uint32_t layers = 1; ///< > 1: gl_Layer chooses
    uint32_t view_mask = 0; ///< multiview instead
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    bool depth_clamp = false;
    bool depth_bias = false;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::vector<VertexStream> streams;
    std::vector<std::pair<BufferId, Use>> buffers; ///< vertex, index, indirect buffers written by earlier passes of this list
    std::function<void(Encoder&)> draw;
};

/// A full-screen triangle with shaders/fullscreen.vert; on lavapipe a fragment pass beats a compute pass (18 against 31 ms for 3x3
/// PCF at 1024x768), so per-pixel work without shared memory is written as one.
struct FullscreenPass {
    std::string name;
    const Program* program = nullptr; ///< device.raster_program("shaders/fullscreen.vert", ...)
    std::vector<Binding> bindings;
    Constants constants;
    std::vector<ColorTarget> colors;
    const TextureTable* textures = nullptr;
};

class PassList {
public:
    explicit PassList(Device&);
    ~PassList();
    PassList(PassList&&) noexcept;

    ImageId import(Image&); ///< the same image gives the same id
    BufferId import(Buffer&);
    ImageId transient(const ImageDesc&); ///< lives for this submission; undefined at first; pooled by the device
    BufferId transient(const BufferDesc&);
    const ImageDesc& desc(ImageId) const;

    void compute(ComputePass);
    void trace(RayPass);
    void raster(RasterPass);
    void fullscreen(FullscreenPass);
    void copy(ImageId from, ImageId to, const char* name = "copy"); ///< whole images of one format and size
    void copy(BufferId from, BufferId to, uint64_t bytes, uint64_t from_offset = 0, uint64_t to_offset = 0, const char* name = "copy");
    void fill(BufferId, uint32_t value, const char* name = "fill");
    void clear(ImageId, VkClearColorValue, const char* name = "clear");

    /// Passes recorded from here on are "common" ones (G-buffer, lighting) or the technique's, which reports separate by name prefix.
    void group(std::string name); ///< prefix "name/" for the passes that follow; "" ends it

    Device& device() const;

private:
    friend class Device;
    friend const struct ListData& contents(const PassList&); ///< describe.h
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::gpu
