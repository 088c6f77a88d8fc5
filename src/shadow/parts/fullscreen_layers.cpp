// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/fullscreen_layers.h"

namespace gnomon::shadow::parts {

void fullscreen_layers(gpu::PassList& passes, gpu::FullscreenPass pass, uint32_t layers)
{
    gpu::RasterPass raster;
    raster.name = std::move(pass.name);
    raster.program = pass.program;
    raster.bindings = std::move(pass.bindings);
    raster.constants = std::move(pass.constants);
    raster.colors = std::move(pass.colors);
    raster.textures = pass.textures;
    raster.layers = layers;
    raster.draw = [layers](gpu::Encoder& encoder) { encoder.draw(3, layers); };
    passes.raster(std::move(raster));
}

} // namespace gnomon::shadow::parts
