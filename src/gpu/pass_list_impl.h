// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/barriers.h"
#include "gpu/pass_list.h"
#include "gpu/programs.h"

#include <variant>

namespace gnomon::gpu {

struct CopyImage {
    ImageId from, to;
};
struct CopyBuffer {
    BufferId from, to;
    uint64_t bytes, from_offset, to_offset;
};
struct FillBuffer {
    BufferId buffer;
    uint32_t value;
};
struct ClearImage {
    ImageId image;
    VkClearColorValue value;
};
struct Pass {
    std::string name;
    std::variant<ComputePass, RayPass, RasterPass, CopyImage, CopyBuffer, FillBuffer, ClearImage> work;
};

template <class Resource, class Desc> struct Listed {
    Resource* imported; ///< null: transient
    Desc desc;
    std::string group{}; ///< PassList::group in which a transient was made
};

struct ListData {
    Device& device;
    std::vector<Listed<Image, ImageDesc>> images;
    std::vector<Listed<Buffer, BufferDesc>> buffers;
    std::vector<Pass> passes;
    std::string group;
    std::string prefix() const { return group.empty() ? "" : group + "/"; }
};
struct PassList::Impl : ListData { };

/// A binding with its defaults filled in, from the image and from what the shader declares.
struct ImagePart {
    VkImageViewType view;
    Range range;
    VkImageAspectFlags aspect;
};
ImagePart part_of(const Binding&, const ImageDesc&, const ReflectedBinding*);

/// What of a pass binds resources, whatever its kind.
struct Bound {
    std::string_view pass;
    const Program* program;
    const std::vector<Binding>& bindings;
    const Constants& constants;
    const TextureTable* textures;
};
/// Throws std::logic_error that names pass, shader and binding. `others`: other programs of the pass may use further bindings.
void check_bound(const Bound&, std::span<const Listed<Image, ImageDesc>>, std::span<const Listed<Buffer, BufferDesc>>, bool others);

} // namespace gnomon::gpu
