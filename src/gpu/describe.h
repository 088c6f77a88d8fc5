// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list_impl.h"

// Reading a list that was recorded and not yet submitted: what somebody would have to do who has the shaders and not this library.
namespace gnomon::gpu {

/// Lives as long as the list.
const ListData& contents(const PassList&);

struct StageDescription {
    std::string shader; ///< its name among the embedded ones
    VkShaderStageFlagBits stage;
};
/// In the order given: vertex, fragment; raygen, misses, then closest and any hit of each hit group.
std::vector<StageDescription> stages_of(const Program&);
std::span<const SpecConstant> constants_of(const Program&);

/// A draw call, with what stands bound and set when it comes.
struct DrawCall {
    enum class Kind : uint8_t { vertices, indexed, indirect, indexed_indirect } kind;
    const Program* program;
    std::vector<std::string> vertex_buffers; ///< by stream, names
    std::string index_buffer;
    VkCullModeFlags cull;
    std::array<float, 3> depth_bias; ///< constant, clamp, slope
    VkViewport viewport;
    VkRect2D scissor;
    uint32_t count, instances, first, first_instance; ///< of vertices or indices; indirect: `count` commands
    int32_t vertex_offset;
    BufferId commands; ///< indirect
    uint64_t offset;
    uint32_t stride;
};
/// Runs the pass's draw function with an encoder that only listens. Valid where the function is: until what it captured is gone.
std::vector<DrawCall> draw_calls(const ListData&, const RasterPass&);

Size render_size(const RasterPass&, const ListData&);
std::string_view format_name(VkFormat); ///< without VK_FORMAT_

} // namespace gnomon::gpu
