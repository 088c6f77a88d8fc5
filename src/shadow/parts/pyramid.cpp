// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/pyramid.h"

#include "gpu/device.h"
#include "shadow/parts/fullscreen_layers.h"

#include <algorithm>
#include <bit>

namespace gnomon::shadow::parts {

namespace {

void fill_levels(gpu::PassList& passes, gpu::ImageId image, const char* name, const char* shader)
{
    const gpu::ImageDesc desc = passes.desc(image);
    const gpu::Program& program = passes.device().raster_program("shaders/fullscreen_layers.vert", shader);
    for (uint32_t mip = 1; mip < desc.mips; ++mip) {
        gpu::ColorTarget target{image, gpu::Load::discard};
        target.mip = mip;
        fullscreen_layers(passes, {name, &program, {gpu::Binding(image, gpu::Use::sample).mips(mip - 1, 1)}, {}, {target}}, desc.layers);
    }
}

} // namespace

uint32_t pyramid_levels(gpu::Size size) { return uint32_t(std::bit_width(uint32_t(std::max({size.width, size.height, 1})))); }

void fill_mean_pyramid(gpu::PassList& passes, gpu::ImageId image)
{
    fill_levels(passes, image, "means", "src/shadow/parts/pyramid_mean.frag");
}

gpu::ImageId build_min_max_pyramid(gpu::PassList& passes, gpu::ImageId from, uint32_t levels)
{
    return build_min_max_pyramid(passes, std::span(&from, 1), levels);
}

gpu::ImageId build_min_max_pyramid(gpu::PassList& passes, std::span<const gpu::ImageId> from, uint32_t levels)
{
    const gpu::Size size = passes.desc(from[0]).size;
    uint32_t layers = 0;
    for (const gpu::ImageId image : from) layers += passes.desc(image).layers;
    levels = std::clamp(levels, 1u, pyramid_levels(size));
    const gpu::ImageId image
        = passes.transient({VK_FORMAT_R32G32_SFLOAT, size, layers, levels, VK_SAMPLE_COUNT_1_BIT, false, "min-max pyramid"});
    const gpu::Program& program = passes.device().raster_program("shaders/fullscreen_layers.vert", "src/shadow/parts/min_max_base.frag");
    uint32_t first = 0;
    for (const gpu::ImageId source : from) {
        const uint32_t count = passes.desc(source).layers;
        gpu::ColorTarget target{image, gpu::Load::discard};
        target.layer = first;
        fullscreen_layers(passes, {"min-max base", &program, {gpu::Binding(source, gpu::Use::sample).mips(0, 1)}, {}, {target}}, count);
        first += count;
    }
    fill_levels(passes, image, "min-max levels", "src/shadow/parts/pyramid_min_max.frag");
    return image;
}

} // namespace gnomon::shadow::parts
