// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/n_buffer.h"

#include "gpu/device.h"
#include "shadow/parts/fullscreen_layers.h"
#include "shadow/parts/image_formats.h"
#include "shadow/parts/pyramid.h"
#include "src/shadow/parts/n_buffer.shared.h"

#include <algorithm>
#include <bit>

namespace gnomon::shadow::parts {

namespace {

enum class Kind : uint8_t { corner_min_max, centred_min_max, mean };

struct Source {
    gpu::ImageId image;
    uint32_t mip = 0;
    bool is_min_max = false; ///< else its first channel is both
};

gpu::Size mip_size(gpu::Size size, uint32_t mip) { return {std::max(size.width >> mip, 1), std::max(size.height >> mip, 1)}; }

void fill_level(gpu::PassList& passes, const NBuffer& buffer, uint32_t level, Kind kind)
{
    const uint32_t layers = uint32_t(buffer.constants.layers);
    // Level l - 1 windows of 2^(l-1) side by side: at 0 and 2^(l-1) where they begin at their texel; where they are centred, half a
    // window to each side, and for two windows of one texel, which have no middle, at -1 and 0.
    const int half = (1 << level) / 4;
    shaders::NBufferConstants constants{0, 1 << (level - 1)};
    if (kind == Kind::centred_min_max) constants = {level == 1 ? -1 : -half, level == 1 ? 0 : half};
    const gpu::Program& program = passes.device().raster_program("shaders/fullscreen_layers.vert",
        kind == Kind::mean ? "src/shadow/parts/n_buffer_mean.frag" : "src/shadow/parts/n_buffer_min_max.frag");
    gpu::ColorTarget target{buffer.image, gpu::Load::discard};
    target.layer = level * layers;
    const gpu::Binding smaller
        = gpu::Binding(buffer.image, gpu::Use::sample).layers((level - 1) * layers, layers, VK_IMAGE_VIEW_TYPE_2D_ARRAY);
    fullscreen_layers(passes, {"window level", &program, {smaller}, constants, {target}}, layers);
}

NBuffer build(gpu::PassList& passes, const Source& from, Kind kind, VkFormat format, uint32_t levels)
{
    const gpu::ImageDesc desc = passes.desc(from.image);
    const gpu::Size size = mip_size(desc.size, from.mip);
    levels = std::clamp(levels, 1u, n_buffer_levels(std::min(size.width, size.height)));
    NBuffer buffer;
    buffer.constants = {int(desc.layers), int(levels), kind == Kind::centred_min_max ? 1 : 0, int(from.mip)};
    buffer.image = passes.transient({format, size, desc.layers * levels, 1, VK_SAMPLE_COUNT_1_BIT, false, "windows"});
    const bool copies = kind == Kind::mean || from.is_min_max;
    const gpu::Program& base = passes.device().raster_program(
        "shaders/fullscreen_layers.vert", copies ? "src/shadow/parts/copy_layers.frag" : "src/shadow/parts/min_max_base.frag");
    fullscreen_layers(passes,
        {"window base", &base, {gpu::Binding(from.image, gpu::Use::sample).mips(from.mip, 1)}, {}, {{buffer.image, gpu::Load::discard}}},
        desc.layers);
    for (uint32_t level = 1; level < levels; ++level) fill_level(passes, buffer, level, kind);
    return buffer;
}

} // namespace

uint32_t n_buffer_levels(int side) { return uint32_t(std::bit_width(uint32_t(std::max(side, 1)))); }

NBuffer build_min_max_n_buffer(gpu::PassList& passes, gpu::ImageId from, uint32_t levels)
{
    return build(passes, {from}, Kind::corner_min_max, VK_FORMAT_R32G32_SFLOAT, levels);
}

NBuffer build_multiscale_map(gpu::PassList& passes, gpu::ImageId from, uint32_t levels)
{
    return build(passes, {from}, Kind::centred_min_max, VK_FORMAT_R32G32_SFLOAT, levels);
}

NBuffer build_multiscale_map_of(gpu::PassList& passes, gpu::ImageId pyramid, uint32_t mip)
{
    return build(passes, {pyramid, mip, true}, Kind::centred_min_max, VK_FORMAT_R32G32_SFLOAT, ~0u);
}

NBuffer build_mean_n_buffer(gpu::PassList& passes, gpu::ImageId from, int channels, uint32_t levels)
{
    return build(passes, {from}, Kind::mean, float_format(channels), levels);
}

NBuffer build_mean_n_buffer(gpu::PassList& passes, gpu::ImageId from, VkFormat format, uint32_t levels)
{
    return build(passes, {from}, Kind::mean, format, levels);
}

YMap build_y_map(gpu::PassList& passes, gpu::ImageId from, uint32_t coarseness)
{
    coarseness = std::min(coarseness, pyramid_levels(passes.desc(from).size) - 1);
    YMap map;
    map.pyramid = build_min_max_pyramid(passes, from, coarseness + 1);
    map.coarse = build_multiscale_map_of(passes, map.pyramid, coarseness);
    return map;
}

} // namespace gnomon::shadow::parts
