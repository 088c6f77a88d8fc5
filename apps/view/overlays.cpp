// SPDX-License-Identifier: Apache-2.0
#include "overlays.h"

#include "apps/view/composite.shared.h"
#include "shadow/light_constants.h"
#include "shadow/parts/texel_footprint.h"
#include "shadow/parts/volume_outlines.h"
#include "side.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace gnomon::view {

namespace {

constexpr uint32_t inset_columns = 4, inset_cell = 192; // pixels a side
constexpr base::Size insets_size{4 * 192, 2 * 192}; // eight layers at most
constexpr float usual_pixels = 24; // a penumbra's width at the end of the colours

} // namespace

const std::array<vec3, 6>& quantity_colors()
{
    // viridis (van der Walt and Smith 2015): brightness rises evenly
    static const std::array<vec3, 6> colors = {vec3(0.267f, 0.005f, 0.329f), vec3(0.254f, 0.265f, 0.530f), vec3(0.164f, 0.471f, 0.558f),
        vec3(0.135f, 0.659f, 0.518f), vec3(0.478f, 0.821f, 0.318f), vec3(0.993f, 0.906f, 0.144f)};
    return colors;
}

std::string OverlayWish::key() const
{
    return fmt::format(" {} {} {} {} {} {} {}", footprint, layers, insets, volumes, inspect, in_pixels, scale);
}

void Overlays::begin(gpu::Device& device, const OverlayWish& wish)
{
    wish_ = wish;
    layer_count_ = 0;
    inspections_.clear(), offers_.clear();
    if (insets_image) return;
    fit_image(device, insets_image, VK_FORMAT_R8G8B8A8_UNORM, insets_size, "insets");
    gpu::PassList passes(device);
    passes.clear(passes.import(insets_image), {});
    device.submit(std::move(passes));
}

const Overlays::Offer* Overlays::offered() const
{
    return wish_.inspect >= 0 && size_t(wish_.inspect) < offers_.size() ? &offers_[size_t(wish_.inspect)] : nullptr;
}

std::string Overlays::missing(std::string_view technique) const
{
    if (layer_count_ == 0 && (wish_.footprint || wish_.layers || wish_.insets))
        return fmt::format("{} looks its shadows up in no light map that could be shown; choose another picture or overlay", technique);
    if (wish_.inspect >= 0 && offers_.empty())
        return fmt::format("{} offers no image of its own to look at (penumbra, pages); choose another technique or overlay", technique);
    return {};
}

void Overlays::draw_map(gpu::PassList& passes, const shadow::Frame& frame, const shadow::parts::LightMap& map)
{
    gpu::Device& device = passes.device();
    const auto constants = [&] {
        return shadow::parts::with_map(
            shaders::MapOverlayConstants{shadow::view_constants(frame.view, 0), map.constants, inset_columns, inset_cell}, map,
            offsetof(shaders::MapOverlayConstants, map));
    };
    if (wish_.footprint) {
        fit_image(device, footprint_image, VK_FORMAT_R32G32B32A32_SFLOAT, frame.view.size, "texel footprint");
        shadow::parts::draw_texel_footprint(passes, frame.gbuffer, frame.view, map, passes.import(footprint_image));
    }
    if (wish_.layers) {
        fit_image(device, layers_image, VK_FORMAT_R8G8B8A8_UNORM, frame.view.size, "layers");
        passes.fullscreen({.name = "layers",
            .program = &device.raster_program("shaders/fullscreen.vert", "apps/view/layers.frag"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}},
            .constants = constants(),
            .colors = {{passes.import(layers_image)}}});
    }
    if (wish_.insets)
        passes.fullscreen({.name = "insets",
            .program = &device.raster_program("shaders/fullscreen.vert", "apps/view/insets.frag"),
            .bindings = {gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)},
            .constants = constants(),
            .colors = {{passes.import(insets_image)}}});
}

void Overlays::draw_inspection(gpu::PassList& passes, const shadow::Frame& frame)
{
    const shadow::Inspection& shown = inspections_[std::min(size_t(wish_.inspect), inspections_.size() - 1)];
    const bool metres = shown.unit == "m", pixels = metres && wish_.in_pixels;
    // some penumbra of a scene: that of a body a tenth of it off, under a sun of two degrees
    const float usual = pixels ? usual_pixels : metres ? 0.01f * frame.resources.bounds().radius() : 1.0f;
    most_ = usual * std::exp2(wish_.scale);
    shaders::InspectConstants c{.view = shadow::view_constants(frame.view, 0), .label = shown.label, .in_pixels = pixels, .most = most_};
    for (size_t i = 0; i < quantity_colors().size(); ++i) c.colors[i] = quantity_colors()[i];
    gpu::Device& device = passes.device();
    fit_image(device, inspect_image, VK_FORMAT_R8G8B8A8_UNORM, frame.view.size, "inspection");
    passes.fullscreen({.name = "inspection",
        .program = &device.raster_program("shaders/fullscreen.vert", "apps/view/inspect.frag"),
        .bindings = {{shown.image, gpu::Use::sample}, {frame.gbuffer.depth, gpu::Use::sample}},
        .constants = c,
        .colors = {{passes.import(inspect_image)}}});
}

void Overlays::record(gpu::PassList& passes, const shadow::Frame& frame, const shadow::parts::LightMap& map, bool transmittance)
{
    layer_count_ = map.constants.layer_count;
    if (layer_count_ > 0) draw_map(passes, frame, map);
    offers_.clear();
    for (const shadow::Inspection& i : inspections_) offers_.push_back({i.name, i.unit, i.label});
    if (!inspections_.empty()) draw_inspection(passes, frame);
    inspections_.clear(); // its images end with the pass list
    if (!wish_.volumes) return;
    fit_image(passes.device(), volumes_image, VK_FORMAT_R8G8B8A8_UNORM, frame.view.size, "volumes");
    shadow::parts::draw_volume_outlines(passes, frame, casters_, {.transmittance = transmittance}, passes.import(volumes_image));
}

} // namespace gnomon::view
