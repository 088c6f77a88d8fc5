// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list_impl.h"

namespace gnomon::gpu {

/// Writes one list into a command buffer: for each pass its barriers, its descriptors and its commands. The states of the imported
/// resources change in commit() only, so that a list that throws leaves them true.
class Recorder {
public:
    Recorder(Context&, ListData&, Submission&, VkCommandBuffer);
    /// `timestamps`: one before the first pass and one after each; null = none.
    void record(VkQueryPool timestamps);
    void commit();

    Image& image(ImageId) const;
    const Buffer& buffer(BufferId) const;
    void bind(const ProgramImpl&, const std::string& pass); ///< sets of the current pass for this program
    Context& context() const { return c_; }
    VkCommandBuffer commands() const { return commands_; }
    bool declared(BufferId, Use) const; ///< by the current pass

private:
    void begin_pass(PassKind, const ProgramImpl&, const std::vector<Binding>&, const Constants&, const TextureTable*);
    void begin_transfer();
    void patch(const Constants&); ///< those of the coming pass, where they will lie
    void use(ImageId, const Range&, Use, PassKind, bool needs_content);
    void use(BufferId, Use, PassKind);
    void end_uses(const std::string& pass); ///< all barriers of the pass, in one call
    VkDescriptorSet new_set(VkDescriptorSetLayout);
    void write_set(const ProgramImpl&, VkDescriptorSet);
    void note_written(const std::string& pass);

    void run(const Pass&, const ComputePass&);
    void run(const Pass&, const RayPass&);
    void run(const Pass&, const RasterPass&);
    void run(const Pass&, const CopyImage&);
    void run(const Pass&, const CopyBuffer&);
    void run(const Pass&, const FillBuffer&);
    void run(const Pass&, const ClearImage&);
    void use_attachments(const RasterPass&);
    void begin_rendering(const RasterPass&, Size);

    Context& c_;
    ListData& list_;
    Submission& submission_;
    VkCommandBuffer commands_;
    std::vector<size_t> image_slots_, buffer_slots_; ///< place among the transients
    std::vector<ImageState> image_states_;
    std::vector<BufferState> buffer_states_;
    std::vector<bool> buffer_written_;
    uint64_t constants_used_ = 0;

    // The current pass.
    const std::vector<Binding>* bindings_ = nullptr;
    const TextureTable* textures_ = nullptr;
    std::vector<ImageUse> image_uses_;
    std::vector<BufferUse> buffer_uses_;
    std::vector<size_t> binding_use_; ///< binding -> image use
    VkDescriptorSet constants_set_ = VK_NULL_HANDLE;
};

/// Attachments' extent and layer count of a raster pass.
Size render_size(const RasterPass&, const ListData&);
uint32_t render_layers(const RasterPass&);

/// Fills the fixed state, binds the program and runs the pass's draw function.
void draw(Recorder&, const RasterPass&, const std::string& name, Size);

} // namespace gnomon::gpu
