// SPDX-License-Identifier: Apache-2.0
#include "gpu/recorder.h"

#include <stdexcept>

namespace gnomon::gpu {

namespace {

class EncoderImpl final : public Encoder {
public:
    EncoderImpl(Recorder& r, const RasterPass& pass, const std::string& name, Size size)
        : r_(r)
        , vk_(r.context().vk)
        , commands_(r.commands())
        , pass_(pass)
        , name_(name)
    {
        fix_state();
        viewport(0, 0, float(size.width), float(size.height));
        scissor(0, 0, uint32_t(size.width), uint32_t(size.height));
        cull(pass.cull);
        depth_bias(0, 0, 0);
        EncoderImpl::program(*pass.program);
    }

    void vertex_buffer(uint32_t stream, const Buffer& b, uint64_t offset) override
    {
        const VkBuffer handle = b.handle();
        vk_.vkCmdBindVertexBuffers(commands_, stream, 1, &handle, &offset);
    }
    void index_buffer(const Buffer& b, uint64_t offset) override
    {
        vk_.vkCmdBindIndexBuffer(commands_, b.handle(), offset, VK_INDEX_TYPE_UINT32);
    }
    void vertex_buffer(uint32_t stream, BufferId id, uint64_t offset) override { vertex_buffer(stream, declared(id, Use::vertex), offset); }
    void index_buffer(BufferId id, uint64_t offset) override { index_buffer(declared(id, Use::index), offset); }
    void cull(VkCullModeFlags mode) override { vk_.vkCmdSetCullMode(commands_, mode); }
    void depth_bias(float constant, float clamp, float slope) override { vk_.vkCmdSetDepthBias(commands_, constant, clamp, slope); }
    void scissor(int x, int y, uint32_t width, uint32_t height) override
    {
        const VkRect2D area{{x, y}, {width, height}};
        vk_.vkCmdSetScissor(commands_, 0, 1, &area);
    }
    void viewport(float x, float y, float width, float height) override
    {
        const VkViewport area{x, y, width, height, 0.0f, 1.0f};
        vk_.vkCmdSetViewport(commands_, 0, 1, &area);
    }
    void draw(uint32_t vertices, uint32_t instances, uint32_t first_vertex, uint32_t first_instance) override
    {
        vk_.vkCmdDraw(commands_, vertices, instances, first_vertex, first_instance);
    }
    void draw_indexed(uint32_t indices, uint32_t instances, uint32_t first_index, int32_t vertex_offset, uint32_t first_instance) override
    {
        vk_.vkCmdDrawIndexed(commands_, indices, instances, first_index, vertex_offset, first_instance);
    }
    void draw_indexed_indirect(BufferId id, uint64_t offset, uint32_t count, uint32_t stride) override
    {
        vk_.vkCmdDrawIndexedIndirect(commands_, declared(id, Use::indirect).handle(), offset, count, stride);
    }
    void draw_indirect(BufferId id, uint64_t offset, uint32_t count, uint32_t stride) override
    {
        vk_.vkCmdDrawIndirect(commands_, declared(id, Use::indirect).handle(), offset, count, stride);
    }
    void program(const Program& p) override
    {
        const auto& impl = static_cast<const ProgramImpl&>(p);
        if (impl.point != VK_PIPELINE_BIND_POINT_GRAPHICS)
            throw std::logic_error(fmt::format("pass '{}': '{}' is no raster program", name_, p.name));
        vk_.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, impl.raster_pipeline(state_));
        r_.bind(impl, name_);
    }
    VkCommandBuffer handle() override { return commands_; }

private:
    void fix_state()
    {
        const auto use_samples = [&](const ImageDesc& d) { state_.samples = d.samples; };
        for (const auto& color : pass_.colors) {
            state_.colors.push_back(color.image ? r_.image(color.image).desc().format : VK_FORMAT_UNDEFINED);
            state_.blends.push_back(color.blend);
            if (color.image) use_samples(r_.image(color.image).desc());
        }
        if (pass_.depth) {
            const DepthTarget& d = *pass_.depth;
            const ImageDesc& desc = r_.image(d.image).desc();
            use_samples(desc);
            state_.depth_format = desc.format;
            state_.depth_write = d.write;
            state_.compare = d.compare;
            state_.stencil = d.stencil;
            state_.front = d.front;
            state_.back = d.back;
        }
        state_.depth_clamp = pass_.depth_clamp;
        state_.depth_bias = pass_.depth_bias;
        state_.view_mask = pass_.view_mask;
        state_.topology = pass_.topology;
        state_.streams = pass_.streams;
    }

    const Buffer& declared(BufferId id, Use how)
    {
        if (!r_.declared(id, how))
            throw std::logic_error(
                fmt::format("pass '{}' draws from a buffer of the list that its `buffers` do not name for this use", name_));
        return r_.buffer(id);
    }

    Recorder& r_;
    const VolkDeviceTable& vk_;
    VkCommandBuffer commands_;
    const RasterPass& pass_;
    const std::string& name_;
    RasterState state_;
};

} // namespace

void draw(Recorder& recorder, const RasterPass& pass, const std::string& name, Size size)
{
    EncoderImpl encoder(recorder, pass, name, size);
    pass.draw(encoder);
}

} // namespace gnomon::gpu
