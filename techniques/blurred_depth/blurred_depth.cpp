// SPDX-License-Identifier: Apache-2.0
// A negative control: the depth is filtered before it is compared. What percentage-closer filtering is right about shows beside it.
#include "techniques/blurred_depth/blurred_depth.shared.h"

#include "shadow/light_constants.h"
#include "shadow/parts/light_map.h"
#include "shadow/technique.h"

namespace gnomon::techniques::blurred_depth {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    fields.integer("map_size", p.map_size, {16, 2048}, "texels", "Width and height of each depth layer.");
    fields.choice(
        "fit", p.fit, {"scene", "view"}, "What a directional light's map covers: the whole scene, or the part of it that the view sees.");
    fields.integer(
        "kernel", p.kernel, {1, 127}, "texels", "Width of the window over which depth is averaged; at most a quarter of the map.");
    fields.choice("compare", p.compare, {"binary", "smooth"}, "Lit or not, or a smooth step over `softness`.");
    fields.real("softness", p.softness, {0.001, 100}, "m", "smooth: depth behind the average at which a receiver is wholly dark.");
    fields.real("bias", p.bias, {0, 1}, "m", "Depth by which a receiver is moved towards the light.");
}

class BlurredDepth final : public TechniqueWith<Params> {
public:
    explicit BlurredDepth(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& values) override
    {
        Params params = values;
        params.kernel = parts::filter_width(params.kernel, params.map_size);
        // Averages over a symmetric window are right on planes: the map needs no more bias than bilinear reads do.
        const parts::LightMap map = parts::draw_light_map(passes, frame,
            {.size = params.map_size,
                .fit = parts::Fit(params.fit),
                .slope_bias = 1.0f,
                .guard_texels = 0.5f * float(params.kernel) + 2.0f});
        const gpu::ImageId blurred = blur(passes, map, blur(passes, map, map.depth, params.kernel, 0), params.kernel, 1);
        passes.fullscreen({.name = "resolve",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/blurred_depth/blurred_depth_resolve.frag"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, as_array(blurred)},
            .constants = ResolveConstants{view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()),
                map.constants, params},
            .colors = {{frame.output}}});
    }

    static gpu::Binding as_array(gpu::ImageId id) { return gpu::Binding(id, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY); }

    gpu::ImageId blur(gpu::PassList& passes, const parts::LightMap& map, gpu::ImageId source, int kernel, int vertical)
    {
        gpu::ImageDesc desc = passes.desc(source);
        desc.format = VK_FORMAT_R32_SFLOAT, desc.name = "blurred depth";
        const gpu::ImageId target = passes.transient(desc);
        for (uint32_t layer = 0; layer < desc.layers; ++layer)
            passes.fullscreen({.name = vertical ? "blur columns" : "blur rows",
                .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/blurred_depth/blurred_depth_blur.frag"),
                .bindings = {as_array(source)},
                .constants = BlurConstants{map.constants.layers[layer], int(layer), kernel, vertical},
                .colors = {{.image = target, .layer = layer}}});
        return target;
    }

    gpu::Device& device_;
};

} // namespace

} // namespace gnomon::techniques::blurred_depth

extern const gnomon::shadow::TechniqueInfo technique_blurred_depth;
const gnomon::shadow::TechniqueInfo technique_blurred_depth = {
    .id = "blurred_depth",
    .title = "Blurred depth (negative control)",
    .family = "shadow maps",
    .cite = "Luft, Deussen 2006",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::blurred_depth::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::blurred_depth::BlurredDepth>(device);
    },
};
