// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_material.h"

#include <cmath>

namespace gnomon::scene::gltf {
namespace {

float unit(double x) { return float(std::clamp(x, 0.0, 1.0)); }

template <int N> glm::vec<N, float> color(const Value& owner, std::string_view key, glm::vec<N, double> otherwise)
{
    owner.numbers_if(key, std::span(&otherwise[0], size_t(N)));
    return glm::vec<N, float>(glm::clamp(otherwise, 0.0, 1.0));
}

/// KHR_texture_transform: uv' = offset + R(rotation) * scale * uv. The extension's text shows R transposed; its example (the lower
/// left quadrant turned clockwise) and the other readers turn counter-clockwise as seen on the picture, whose v points down.
void read_transform(const Value& transform, TextureUse& out)
{
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    transform.numbers_if("offset", offset);
    transform.numbers_if("scale", scale);
    const double angle = transform.number_or("rotation", 0.0), c = std::cos(angle), s = std::sin(angle);
    out.u_row = vec3(c * scale[0], s * scale[1], offset[0]);
    out.v_row = vec3(-s * scale[0], c * scale[1], offset[1]);
}

void read_glass(const Value& material, Material& out)
{
    const Value transmission = material.extension("KHR_materials_transmission");
    if (!transmission) return;
    out.transmission = unit(transmission.number_or("transmissionFactor", 0.0));
    const Value volume = material.extension("KHR_materials_volume");
    if (!volume) return;
    out.thickness = float(std::clamp(volume.number_or("thicknessFactor", 0.0), 0.0, 1e6));
    out.attenuation_color = color<3>(volume, "attenuationColor", glm::dvec3(1));
    const double distance = volume.number_or("attenuationDistance", 0.0); // absent: infinite; 0 is not allowed
    if (distance > 0) out.attenuation_distance = float(distance);
}

void read_alpha(const Value& material, Material& out)
{
    const std::string mode = material.text_or("alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") material.bad("has the unknown alphaMode '{}'", printable(mode));
    out.alpha = mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
    out.alpha_cutoff = float(material.number_or("alphaCutoff", 0.5));
    out.double_sided = material.flag_or("doubleSided", false);
}

} // namespace

TextureUse Materials::texture(const Value& info, bool srgb, int& uv_set)
{
    TextureUse out;
    if (!info) return out;
    document_.recover("the texture is left out", [&] {
        const Value transform = info.extension("KHR_texture_transform");
        const uint64_t set = transform.integer_or("texCoord", info.integer_or("texCoord", 0));
        if (set > 7) info.bad("uses texture coordinates {}", set);
        if (uv_set >= 0 && uv_set != int(set))
            info.bad("uses TEXCOORD_{}, but a mesh keeps one set, here TEXCOORD_{} (bake the texture to that set)", set, uv_set);
        const int index = texture_index(info.at("index"), srgb);
        if (index < 0) return;
        out.texture = index;
        uv_set = int(set);
        if (transform) read_transform(transform, out);
    });
    return out;
}

/// Colour and textures. The base colour comes first: its texture chooses the set of texture coordinates.
void Materials::read_surface(const Value& material, Material& out, int& uv_set)
{
    const Value glossiness = material.extension("KHR_materials_pbrSpecularGlossiness");
    if (glossiness) {
        out.base_color = color<4>(glossiness, "diffuseFactor", glm::dvec4(1));
        out.base_color_texture = texture(glossiness.find("diffuseTexture"), true, uv_set);
        out.roughness = unit(1.0 - glossiness.number_or("glossinessFactor", 1.0));
    } else {
        const Value pbr = material.find("pbrMetallicRoughness");
        out.base_color = color<4>(pbr, "baseColorFactor", glm::dvec4(1));
        out.base_color_texture = texture(pbr.find("baseColorTexture"), true, uv_set);
        out.metallic = unit(pbr.number_or("metallicFactor", 1.0));
        out.roughness = unit(pbr.number_or("roughnessFactor", 1.0));
        out.metallic_roughness_texture = texture(pbr.find("metallicRoughnessTexture"), false, uv_set);
    }
    const double strength = material.extension("KHR_materials_emissive_strength").number_or("emissiveStrength", 1.0);
    out.emissive = color<3>(material, "emissiveFactor", glm::dvec3(0)) * float(std::clamp(strength, 0.0, 1e9));
    out.emissive_texture = texture(material.find("emissiveTexture"), true, uv_set);
    if (material.extension("KHR_materials_unlit")) { // shadows need a lit surface: a matt one of that colour
        out.metallic = 0.0f;
        out.roughness = 1.0f;
        out.metallic_roughness_texture = {};
    }
}

Materials::Use Materials::make(const Value& material)
{
    Material out;
    Use use;
    if (!material) {
        // glTF's own default is a metal, which is black without surroundings to mirror: Gnomon's is matt.
        out.name = "default";
    } else {
        out.name = material.text_or("name", material.path());
        read_alpha(material, out);
        read_surface(material, out, use.uv_set);
        read_glass(material, out);
    }
    use.material = int(scene_.materials.size());
    scene_.materials.push_back(std::move(out));
    return use;
}

Materials::Use Materials::use(const Value& primitive)
{
    const Value reference = primitive.find("material");
    const int64_t key = reference ? int64_t(reference.integer()) : -1;
    if (const auto it = made_.find(key); it != made_.end()) return it->second;
    Use made;
    const bool read = document_.recover("the default material is used",
        [&] { made = make(reference ? document_.element("materials", reference) : Value(nullptr, "", document_.file())); });
    if (!read) made = use(Value(nullptr, "", document_.file()));
    return made_[key] = made;
}

} // namespace gnomon::scene::gltf
