// SPDX-License-Identifier: Apache-2.0
#include "gpu/describe.h"

#include "gpu/context.h"

namespace gnomon::gpu {

namespace {

class Listener final : public Encoder {
public:
    Listener(const ListData& list, const RasterPass& pass, std::vector<DrawCall>& out)
        : list_(list)
        , out_(out)
    {
        const Size size = render_size(pass, list);
        now_.program = pass.program;
        now_.cull = pass.cull;
        now_.viewport = {0, 0, float(size.width), float(size.height), 0, 1};
        now_.scissor = {{0, 0}, {uint32_t(size.width), uint32_t(size.height)}};
    }

    void vertex_buffer(uint32_t stream, const Buffer& b, uint64_t) override { bind(stream, b.desc().name); }
    void vertex_buffer(uint32_t stream, BufferId id, uint64_t) override { bind(stream, name(id)); }
    void index_buffer(const Buffer& b, uint64_t) override { now_.index_buffer = b.desc().name; }
    void index_buffer(BufferId id, uint64_t) override { now_.index_buffer = name(id); }
    void cull(VkCullModeFlags mode) override { now_.cull = mode; }
    void depth_bias(float constant, float clamp, float slope) override { now_.depth_bias = {constant, clamp, slope}; }
    void scissor(int x, int y, uint32_t width, uint32_t height) override { now_.scissor = {{x, y}, {width, height}}; }
    void viewport(float x, float y, float width, float height) override { now_.viewport = {x, y, width, height, 0, 1}; }
    void draw(uint32_t vertices, uint32_t instances, uint32_t first_vertex, uint32_t first_instance) override
    {
        add(DrawCall::Kind::vertices, vertices, instances, first_vertex, first_instance, 0);
    }
    void draw_indexed(uint32_t indices, uint32_t instances, uint32_t first_index, int32_t vertex_offset, uint32_t first_instance) override
    {
        add(DrawCall::Kind::indexed, indices, instances, first_index, first_instance, vertex_offset);
    }
    void draw_indexed_indirect(BufferId id, uint64_t offset, uint32_t count, uint32_t stride) override
    {
        add_indirect(DrawCall::Kind::indexed_indirect, id, offset, count, stride);
    }
    void draw_indirect(BufferId id, uint64_t offset, uint32_t count, uint32_t stride) override
    {
        add_indirect(DrawCall::Kind::indirect, id, offset, count, stride);
    }
    void program(const Program& p) override { now_.program = &p; }
    VkCommandBuffer handle() override
    {
        throw std::logic_error("a pass that records commands of its own cannot be described; give the encoder what it needs");
    }

private:
    const std::string& name(BufferId id) const { return list_.buffers[id.index].desc.name; }
    void bind(uint32_t stream, const std::string& buffer)
    {
        if (now_.vertex_buffers.size() <= stream) now_.vertex_buffers.resize(stream + 1);
        now_.vertex_buffers[stream] = buffer;
    }
    void add(DrawCall::Kind kind, uint32_t count, uint32_t instances, uint32_t first, uint32_t first_instance, int32_t vertex_offset)
    {
        DrawCall call = now_;
        call.kind = kind, call.count = count, call.instances = instances, call.first = first, call.first_instance = first_instance;
        call.vertex_offset = vertex_offset;
        out_.push_back(std::move(call));
    }
    void add_indirect(DrawCall::Kind kind, BufferId commands, uint64_t offset, uint32_t count, uint32_t stride)
    {
        DrawCall call = now_;
        call.kind = kind, call.count = count, call.commands = commands, call.offset = offset, call.stride = stride;
        out_.push_back(std::move(call));
    }

    const ListData& list_;
    std::vector<DrawCall>& out_;
    DrawCall now_{};
};

} // namespace

const ListData& contents(const PassList& list) { return *list.impl_; }

std::vector<StageDescription> stages_of(const Program& program)
{
    std::vector<StageDescription> out;
    for (const ShaderStage& s : static_cast<const ProgramImpl&>(program).stages) out.push_back({s.shader, s.stage});
    return out;
}

std::span<const SpecConstant> constants_of(const Program& program) { return static_cast<const ProgramImpl&>(program).constants; }

std::vector<DrawCall> draw_calls(const ListData& list, const RasterPass& pass)
{
    std::vector<DrawCall> out;
    Listener listener(list, pass, out);
    pass.draw(listener);
    return out;
}

std::string_view format_name(VkFormat format)
{
    // of vertices alone, which the images' table lacks
    return format == VK_FORMAT_R32G32B32_SFLOAT ? "R32G32B32_SFLOAT" : format_info(format).name;
}

} // namespace gnomon::gpu
