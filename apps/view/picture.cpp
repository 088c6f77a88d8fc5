// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include "apps/view/composite.shared.h"
#include "shadow/light_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::view {

const std::vector<std::string>& show_names()
{
    static const std::vector<std::string> names = {"lit", "visibility", "error", "depth", "normal", "geometric_normal", "albedo", "surface",
        "primitive", "position", "texel_footprint", "texel_footprint_perspective", "texel_footprint_projection"};
    return names;
}

namespace {

/// Greatest distance along the view to the scene's bounds.
float farthest(const lab::Stage& stage)
{
    float most = 1e-3f;
    const Bounds& b = stage.bounds;
    for (int i = 0; i < 8; ++i) {
        const vec3 corner(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z);
        most = std::max(most, -(stage.view.view_from_world * vec4(corner, 1)).z);
    }
    return most;
}

bool colored(const gpu::Image& image) { return image && image.desc().format == VK_FORMAT_R32G32B32A32_SFLOAT; }

} // namespace

Picture::Picture(gpu::Device& device, shadow::SceneGpu& scene)
    : device_(device)
    , scene_(scene)
{
    fit_image(device, dummy_, VK_FORMAT_R32_SFLOAT, {1, 1}, "nothing");
    fit_image(device, dummy_ids_, VK_FORMAT_R32_UINT, {1, 1}, "nothing");
    gpu::PassList passes(device);
    for (gpu::Image* image : {&dummy_, &dummy_ids_}) passes.clear(passes.import(*image), {});
    device.submit(std::move(passes));
    overlays_.begin(device, {});
}

void Picture::draw_again()
{
    receivers_key_.clear();
    left_.draw_again();
}

void Picture::forget()
{
    receivers_key_.clear();
    left_.forget(), right_.forget();
}

bool Picture::draw(const Wish& wish)
{
    const std::string view = view_key(wish.stage);
    if (view != receivers_key_) {
        receiver_times_ = receivers_.draw(device_, scene_, wish.stage.view);
        receivers_key_ = view;
    }
    const std::string common = view + lights_key(wish.stage) + fmt::format(" {}", wish.ambient);
    const std::string own = common + lab::choice_text(wish.left) + wish.overlays.key();
    if (own != overlays_key_) overlays_.begin(device_, wish.overlays);
    overlays_key_ = own;
    const bool drawn = left_.draw(device_, scene_, receivers_, wish.stage, wish.left, wish.ambient, own, &overlays_);
    if (left_.error.empty()) left_.error = overlays_.missing(wish.left.info->id);
    if (wish.right)
        right_.draw(
            device_, scene_, receivers_, wish.stage, *wish.right, wish.ambient, common + " " + lab::choice_text(*wish.right), nullptr);
    else if (wish.against_truth)
        draw_truth(wish, common);
    return drawn;
}

void Picture::draw_truth(const Wish& wish, const std::string& key)
{
    if (!wish.truth || wish.truth->images.empty()) {
        right_.valid = false;
        return;
    }
    const std::string own = fmt::format("{} truth {} {}", key, wish.truth->key, wish.truth->samples);
    if (!right_.draw(device_, scene_, receivers_, wish.stage, wish.truth->images, wish.ambient, own)) return;
    fit_image(device_, truth_primitive_, VK_FORMAT_R32_UINT, wish.stage.view.size, "truth's primitives");
    device_.upload(truth_primitive_, std::as_bytes(std::span(wish.truth->primitive)));
}

uint32_t Picture::right_kind(const Wish& wish) const
{
    if (!wish.right && !wish.against_truth) return RIGHT_NONE;
    if (!right_.valid || right_.radiance.desc().size != wish.stage.view.size || !right_.error.empty()) return RIGHT_MISSING;
    return wish.right ? RIGHT_TECHNIQUE : RIGHT_TRUTH;
}

void Picture::compose(const Wish& wish, const Look& look)
{
    fit_image(device_, canvas_, VK_FORMAT_R8G8B8A8_UNORM, wish.stage.view.size, "canvas");
    gpu::PassList passes(device_);
    const shadow::GBuffer g = receivers_.import(passes);
    const auto or_nothing = [&](gpu::Image& image) { return passes.import(image ? image : dummy_); };
    const auto first = [&](Side& side) { return or_nothing(side.visibility.empty() ? dummy_ : side.visibility.front()); };
    const bool left = left_.valid && left_.radiance.desc().size == wish.stage.view.size;
    const uint32_t right = right_kind(wish);
    shaders::CompositeConstants c{};
    c.view = shadow::view_constants(wish.stage.view, 0);
    c.show = look.show, c.right = right;
    c.split = look.split * float(wish.stage.view.size.width);
    c.exposure = pi / shadow::reference_irradiance(wish.stage.lights, wish.stage.bounds) * std::exp2(look.exposure) * 1.25f;
    c.range = look.range, c.farthest = farthest(wish.stage);
    c.extent = glm::max(glm::length(wish.stage.bounds.min), glm::length(wish.stage.bounds.max));
    const auto& overlay = [&](gpu::Image& image) -> gpu::Image& {
        return image && image.desc().size == wish.stage.view.size && left_.error.empty() ? image : dummy_;
    };
    const auto there = [&](bool wanted, gpu::Image& image) { return wanted && &overlay(image) != &dummy_ ? 1u : 0u; };
    c.wireframe = look.wireframe, c.layers = there(wish.overlays.layers, overlays_.layers_image);
    c.volumes = there(wish.overlays.volumes, overlays_.volumes_image);
    c.inspect = there(overlays_.offered() != nullptr, overlays_.inspect_image);
    c.left_colored = !left_.visibility.empty() && colored(left_.visibility.front());
    c.right_colored = !right_.visibility.empty() && colored(right_.visibility.front());
    passes.fullscreen({.name = "composite",
        .program = &device_.raster_program("shaders/fullscreen.vert", "apps/view/composite.frag"),
        .bindings = {{left ? passes.import(left_.radiance) : passes.import(dummy_), gpu::Use::sample},
            {right >= RIGHT_TECHNIQUE ? passes.import(right_.radiance) : passes.import(dummy_), gpu::Use::sample},
            {left ? first(left_) : passes.import(dummy_), gpu::Use::sample},
            {right >= RIGHT_TECHNIQUE ? first(right_) : passes.import(dummy_), gpu::Use::sample}, {g.depth, gpu::Use::sample},
            {g.normal, gpu::Use::sample}, {g.albedo, gpu::Use::sample}, {g.surface, gpu::Use::sample}, {g.primitive, gpu::Use::sample},
            {passes.import(overlay(overlays_.footprint_image)), gpu::Use::sample},
            {passes.import(overlay(overlays_.layers_image)), gpu::Use::sample},
            {passes.import(right == RIGHT_TRUTH && truth_primitive_ ? truth_primitive_ : dummy_ids_), gpu::Use::sample},
            {passes.import(overlay(overlays_.volumes_image)), gpu::Use::sample},
            {passes.import(overlay(overlays_.inspect_image)), gpu::Use::sample}},
        .constants = c,
        .colors = {{passes.import(canvas_), gpu::Load::discard}}});
    compose_times_ = device_.submit(std::move(passes)).times;
}

base::Picture Picture::radiance()
{
    const base::Picture rgba = device_.read_back(left_.radiance);
    base::Picture out(rgba.size, 3);
    for (size_t i = 0; i < rgba.size.area(); ++i) std::copy_n(&rgba.values[i * 4], 3, &out.values[i * 3]);
    return out;
}

base::Picture Picture::shown()
{
    const base::Picture rgba = device_.read_back(canvas_);
    base::Picture out(rgba.size, 3);
    for (size_t i = 0; i < rgba.size.area(); ++i) std::copy_n(&rgba.values[i * 4], 3, &out.values[i * 3]);
    return out;
}

} // namespace gnomon::view
