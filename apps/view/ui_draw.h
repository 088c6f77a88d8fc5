// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"

struct ImDrawData;

namespace gnomon::view {

/// Draws what Dear ImGui has laid out, by a pass list. Not its own Vulkan backend: Debian's wants a VkRenderPass and is linked to the
/// Vulkan loader, whose functions have the names of volk's variables.
class UiDraw {
public:
    explicit UiDraw(gpu::Device&); ///< after ImGui's context: makes its font
    /// Over the whole of `target`. The images are what UI_CANVAS and UI_INSETS name. What it is given must not be in use any more.
    void record(gpu::PassList&, const ImDrawData&, gpu::ImageId target, gpu::Image& canvas, gpu::Image& insets);

private:
    void upload(const ImDrawData&);
    gpu::Device& device_;
    gpu::Image font_;
    gpu::Buffer vertices_, indices_;
};

} // namespace gnomon::view
