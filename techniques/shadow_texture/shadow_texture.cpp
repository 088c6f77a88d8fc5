// SPDX-License-Identifier: Apache-2.0
// Projective shadow textures (Segal, Korobkin, van Widenfelt, Foran, Haeberli 1992; Nagy 2000): a picture of the casters alone, black on
// white, projected from the light onto the receivers.
#include "techniques/shadow_texture/shadow_texture.shared.h"

#include "scene/light_image.h"
#include "shadow/light_constants.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/window.h"
#include "shadow/technique.h"
#include "techniques/shadow_texture/caster_bits.h"

#include <algorithm>
#include <cmath>

namespace gnomon::techniques::shadow_texture {

namespace {

using namespace shadow;

constexpr const char* cookies[] = {"none", "halves", "window", "glow"};

void describe(Params& p, Fields& fields)
{
    fields.integer(
        "texture_size", p.texture_size, {16, 4096}, "texels", "Width and height of the texture; of each of six for a point light.");
    fields.real("largest_caster", p.largest_caster, {0, 1}, "",
        "Instances with at most this fraction of the scene's radius cast; larger ones receive.");
    fields.choice("receivers", p.receivers, {"large", "all"},
        "Who is shadowed: the instances that cast nothing, or casters too, which then lie in their own shadows.");
    fields.integer("blur", p.blur, {1, 65}, "texels", "Width of the Gaussian that softens the texture, whatever the distances; 1 = none.");
    fields.choice("cookie", p.cookie, {"none", "halves", "window", "glow"},
        "A picture before a spot light that fills its cone, in grey. The truth knows nothing of it.");
    fields.real("cookie_turn", p.cookie_turn, {-360, 360}, "degrees", "By how much the cookie turns from frame to frame.");
}

/// Width, height and what is let through, the brightest texel all: the built-in images of rectangular lights, their luminance (Rec. 709).
std::vector<float> cookie_content(int cookie)
{
    const scene::LightImage image = scene::load_light_image(cookies[cookie]);
    std::vector<float> out = {float(std::max(image.width, 1)), float(std::max(image.height, 1))};
    constexpr vec3 luminance(0.2126f, 0.7152f, 0.0722f);
    float most = 0;
    for (const vec3 t : image.texels) most = std::max(most, glm::dot(t * image.tint, luminance));
    for (const vec3 t : image.texels) out.push_back(glm::dot(t * image.tint, luminance) / most);
    if (image.empty()) out.push_back(1.0f);
    return out;
}

class ShadowTexture final : public TechniqueWith<Params> {
public:
    explicit ShadowTexture(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        prepare(frame, params);
        const parts::LightMapSettings settings{
            .size = params.texture_size, .guard_texels = 0.5f * float(parts::filter_width(params.blur, params.texture_size)) + 1.0f};
        const shaders::LightMap map = parts::fit_light_map(frame.scene, frame.resources.bounds(), frame.view, frame.light, settings);
        gpu::ImageId texture = passes.transient({VK_FORMAT_R8_UNORM, {params.texture_size, params.texture_size}, map.layer_count, 1,
            VK_SAMPLE_COUNT_1_BIT, false, "shadow texture"});
        draw(passes, frame, map, settings, texture);
        const int blur = parts::filter_width(params.blur, params.texture_size);
        if (blur > 1) texture = parts::window_gaussian(passes, texture, blur);

        ResolveConstants c{
            view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()), map, params, mat3(1), 1};
        if (const auto* spot = std::get_if<scene::SpotLight>(&frame.light.shape)) {
            c.cookie_axes = glm::transpose(mat3(parts::light_axes(spot->position, spot->direction, vec3(0, 1, 0))));
            c.cookie_scale = std::tan(std::min(spot->outer_angle, 1.5f));
        } else {
            c.params.cookie = 0;
        }
        passes.fullscreen({.name = "resolve",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/shadow_texture/shadow_texture_resolve.frag"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                {frame.gbuffer.primitive, gpu::Use::sample}, {passes.import(bits_), gpu::Use::load},
                gpu::Binding(texture, gpu::Use::sample, gpu::Sampler::linear_clamp).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
                {passes.import(cookie_), gpu::Use::load}},
            .constants = c,
            .colors = {{frame.output}}});
    }

    void prepare(const Frame& frame, const Params& params)
    {
        if (content_ != frame.resources.content() || params.largest_caster != made_with_.largest_caster)
            bits_ = upload(caster_bits(frame.scene, params.largest_caster), "casters");
        if (!cookie_ || params.cookie != made_with_.cookie) cookie_ = upload(cookie_content(params.cookie), "cookie");
        made_with_ = params, content_ = frame.resources.content();
    }

    template <class T> gpu::Buffer upload(const std::vector<T>& values, const char* name)
    {
        gpu::Buffer buffer = device_.buffer({values.size() * sizeof(T), 0, gpu::Memory::device, name});
        device_.upload(buffer, std::as_bytes(std::span(values)));
        return buffer;
    }

    void draw(gpu::PassList& passes, const Frame& frame, const shaders::LightMap& map, const parts::LightMapSettings& settings,
        gpu::ImageId texture)
    {
        CasterConstants c{};
        for (uint32_t l = 0; l < map.layer_count; ++l) c.clip_from_world[l] = parts::clip_from_world(map.layers[l]);
        gpu::RasterPass pass;
        pass.name = "texture";
        pass.program = &device_.raster_program(
            "techniques/shadow_texture/shadow_texture_casters.vert", "techniques/shadow_texture/shadow_texture_casters.frag");
        pass.bindings = {{passes.import(bits_), gpu::Use::load}};
        pass.constants = c;
        gpu::ColorTarget white{.image = texture};
        white.clear.float32[0] = 1.0f;
        pass.colors = {white};
        parts::draw_casters(passes, frame, map, settings, std::move(pass),
            device_.raster_program(
                "techniques/shadow_texture/shadow_texture_masked.vert", "techniques/shadow_texture/shadow_texture_masked.frag"));
    }

    gpu::Device& device_;
    gpu::Buffer bits_, cookie_;
    std::shared_ptr<const void> content_; ///< the casters in bits_
    Params made_with_;
};

} // namespace

} // namespace gnomon::techniques::shadow_texture

extern const gnomon::shadow::TechniqueInfo technique_shadow_texture;
const gnomon::shadow::TechniqueInfo technique_shadow_texture = {
    .id = "shadow_texture",
    .title = "Shadow texture",
    .family = "projection shadows",
    .cite = "Segal et al. 1992; Nagy 2000",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .partial = true,
    .reads_ids = [](std::span<const std::byte>) { return true; },
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::shadow_texture::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::shadow_texture::ShadowTexture>(device);
    },
};
