// SPDX-License-Identifier: Apache-2.0
#include "ui_draw.h"

#include "apps/view/ui.shared.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace gnomon::view {

namespace {

gpu::VertexStream stream()
{
    return {sizeof(ImDrawVert),
        {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)}, {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
            {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}}};
}

void grow(gpu::Device& device, gpu::Buffer& buffer, uint64_t bytes, VkBufferUsageFlags usage, const char* name)
{
    if (buffer && buffer.desc().bytes >= bytes) return;
    buffer = device.buffer({bytes + bytes / 2 + 4096, usage, gpu::Memory::upload, name});
}

void draw(gpu::Encoder& encoder, const ImDrawData& data, base::Size size, const gpu::Buffer& vertices, const gpu::Buffer& indices)
{
    encoder.vertex_buffer(0, vertices, 0);
    encoder.index_buffer(indices, 0);
    uint32_t first_index = 0;
    int32_t first_vertex = 0;
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const int x0 = std::clamp(int(command.ClipRect.x), 0, size.width), y0 = std::clamp(int(command.ClipRect.y), 0, size.height);
            const int x1 = std::clamp(int(command.ClipRect.z), 0, size.width), y1 = std::clamp(int(command.ClipRect.w), 0, size.height);
            if (x1 <= x0 || y1 <= y0 || command.UserCallback) continue;
            encoder.scissor(x0, y0, uint32_t(x1 - x0), uint32_t(y1 - y0));
            const uint32_t fill = uint32_t(reinterpret_cast<uintptr_t>(command.TextureId));
            encoder.draw_indexed(command.ElemCount, 1, first_index + command.IdxOffset, first_vertex + int32_t(command.VtxOffset), fill);
        }
        first_index += uint32_t(list.IdxBuffer.Size), first_vertex += list.VtxBuffer.Size;
    }
}

} // namespace

UiDraw::UiDraw(gpu::Device& device)
    : device_(device)
{
    ImGuiIO& io = ImGui::GetIO();
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    unsigned char* texels = nullptr;
    base::Size size;
    io.Fonts->GetTexDataAsAlpha8(&texels, &size.width, &size.height);
    font_ = device.image({VK_FORMAT_R8_UNORM, size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "font"});
    device.upload(font_, std::as_bytes(std::span(texels, size.area())));
    io.Fonts->SetTexID(reinterpret_cast<ImTextureID>(uintptr_t(UI_FONT)));
}

/// Indices become 32 bits wide, the only ones that an Encoder takes.
void UiDraw::upload(const ImDrawData& data)
{
    grow(device_, vertices_, uint64_t(data.TotalVtxCount) * sizeof(ImDrawVert), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "user interface");
    grow(device_, indices_, uint64_t(data.TotalIdxCount) * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "user interface");
    std::byte* vertex = vertices_.mapped();
    auto* index = reinterpret_cast<uint32_t*>(indices_.mapped());
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        memcpy(vertex, list.VtxBuffer.Data, size_t(list.VtxBuffer.Size) * sizeof(ImDrawVert));
        vertex += size_t(list.VtxBuffer.Size) * sizeof(ImDrawVert);
        index = std::copy(list.IdxBuffer.begin(), list.IdxBuffer.end(), index);
    }
}

void UiDraw::record(gpu::PassList& passes, const ImDrawData& data, gpu::ImageId target, gpu::Image& canvas, gpu::Image& insets)
{
    upload(data);
    const base::Size size = passes.desc(target).size;
    const vec2 extent(std::max(data.DisplaySize.x, 1.0f), std::max(data.DisplaySize.y, 1.0f));
    gpu::RasterPass pass;
    pass.name = "user interface";
    pass.program = &device_.raster_program("apps/view/ui.vert", "apps/view/ui.frag");
    pass.bindings = {{passes.import(font_), gpu::Use::sample, gpu::Sampler::linear_clamp},
        {passes.import(canvas), gpu::Use::sample, gpu::Sampler::linear_clamp},
        {passes.import(insets), gpu::Use::sample, gpu::Sampler::nearest_clamp}};
    pass.constants = shaders::UiConstants{2.0f / extent, vec2(-1)};
    const VkPipelineColorBlendAttachmentState over{VK_TRUE, VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, VK_BLEND_OP_ADD,
        VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, VK_BLEND_OP_ADD, 0xf};
    pass.colors = {{.image = target, .clear = {{0.07f, 0.07f, 0.08f, 1.0f}}, .blend = over}};
    pass.streams = {stream()};
    pass.draw = [&data, size, this](gpu::Encoder& encoder) { draw(encoder, data, size, vertices_, indices_); };
    passes.raster(std::move(pass));
}

} // namespace gnomon::view
