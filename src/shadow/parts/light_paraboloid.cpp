// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/fit.h"

#include "src/shadow/parts/light_depth_paraboloid.shared.h"

namespace gnomon::shadow::parts {

void draw_paraboloid_layers(
    gpu::PassList& passes, const Frame& frame, const shaders::LightMap& map, const LightMapSettings& settings, gpu::ImageId depth)
{
    SceneGpu& scene = frame.resources;
    shaders::ParaboloidConstants c{};
    for (uint32_t l = 0; l < map.layer_count; ++l) c.map_from_world[l] = map.layers[l].map_from_world;
    c.near = map.layers[0].near, c.far = map.layers[0].far;
    c.slope_bias = settings.slope_bias, c.size = map.size;
    c.cull = settings.cull == VK_CULL_MODE_BACK_BIT ? 1 : settings.cull == VK_CULL_MODE_FRONT_BIT ? 2 : 0;
    gpu::RasterPass pass;
    pass.name = "light map";
    pass.program
        = &passes.device().raster_program("src/shadow/parts/light_depth_paraboloid.vert", "src/shadow/parts/light_depth_paraboloid.frag");
    pass.bindings = {{passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load},
        {passes.import(scene.positions()), gpu::Use::load}, {passes.import(scene.indices()), gpu::Use::load},
        {passes.import(scene.attributes()), gpu::Use::load}};
    pass.constants = c;
    pass.textures = &scene.textures();
    pass.depth = gpu::DepthTarget{depth};
    pass.layers = map.layer_count;
    pass.draw = [&scene, layers = map.layer_count](gpu::Encoder& encoder) {
        for (uint32_t l = 0; l < layers; ++l) scene.draw(encoder, {.sets = draw_opaque | draw_masked, .layer = l, .pulled = 6});
    };
    passes.raster(std::move(pass));
}

} // namespace gnomon::shadow::parts
