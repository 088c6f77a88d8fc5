// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipelines.h"
#include "shadows.h"

#include <array>
#include <optional>

namespace host {

/// What a size of the picture needs. The frames in flight share them: one queue runs them one after another.
struct Targets {
    Image depth;
    std::optional<Image> normals; ///< of one sample, as Gnomon reads them
    std::optional<Image> normals_samples; ///< that `normals` are resolved from
    Image visibility; ///< Gnomon's output
    Image color; ///< as many samples as the depth; unused where that is one
    Image picture; ///< what is shown
};

/// Draws the scene: depth and normals, the shadow, the lit picture.
class Renderer {
public:
    Renderer(const Gpu&, const Scene&, Shadows&, const Options&);

    /// The old targets go once the frames that use them have finished; nothing waits.
    void resize(VkExtent2D);
    /// Waits until the frame before the last one has finished, and begins a command buffer.
    VkCommandBuffer begin(uint32_t frame);
    /// Records all passes; `picture` is then in TRANSFER_SRC_OPTIMAL, to be read by transfers.
    void draw(uint32_t frame, size_t technique);
    void submit(VkSemaphore wait, VkSemaphore signal); ///< either may be null; `wait` holds back transfers
    void finish(); ///< waits for all frames
    void save(const std::string& path); ///< after `finish`; the last frame's picture as .ppm
    const Image& picture() const { return targets_.picture; }

    void destroyers(std::vector<std::function<void()>>& out);

private:
    struct Slot { // of a frame in flight
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence fence = VK_NULL_HANDLE;
        VkDescriptorSet set = VK_NULL_HANDLE;
        Buffer instances;
        uint64_t ticket = 0; ///< Gnomon's; 0: none
        bool submitted = false;
    };
    struct Retired {
        uint32_t frame; ///< the last that may use it
        Image image;
    };
    void wait(Slot&);
    void make_targets(VkExtent2D);
    std::vector<Image> images_of_targets() const;
    void draw_scene(VkPipeline, const Slot&, const PushConstants&) const;
    void depth_pass(const Slot&, const PushConstants&) const;
    void lit_pass(const Slot&, const PushConstants&) const;

    const Gpu& gpu_;
    const Scene& scene_;
    Shadows& shadows_;
    Options options_;
    Pipelines pipelines_;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    std::array<Slot, 2> slots_;
    Slot* slot_ = nullptr; ///< of the frame that is recorded
    uint32_t frame_ = 0;
    Targets targets_{};
    std::vector<Retired> retired_;
};

/// An image barrier for all of a colour or depth image.
void transition(VkCommandBuffer, const Image&, VkImageAspectFlags, VkImageLayout from, VkImageLayout to, VkPipelineStageFlags2 after,
    VkAccessFlags2 written, VkPipelineStageFlags2 before, VkAccessFlags2 used);

} // namespace host
