// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"
#include "scene/math.h"
#include "scene/view.h"

#include <cstdint>
#include <string>
#include <vector>

// A scene is a value: arrays that refer to one another by index. Units are metres, +Y is up, right-handed, as in glTF.
// Front faces are counter-clockwise seen from outside.
namespace gnomon::scene {

enum class Wrap : uint8_t { repeat, mirror, clamp };

/// An 8-bit RGBA image with its addressing; row 0 is v = 0.
struct Texture {
    std::string name;
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;
    bool srgb = true; ///< colour data (base colour, emissive); false for metallic-roughness
    bool linear = true; ///< linear filtering; false = nearest
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

/// A texture with KHR_texture_transform: uv' = offset + R(rotation) * (scale * uv), as three-column rows u and v.
struct TextureUse {
    int texture = -1; ///< index into Scene::textures; -1 = none (all ones)
    vec3 u_row{1, 0, 0}, v_row{0, 1, 0}; ///< u' = dot(u_row, (u, v, 1)), v' = dot(v_row, (u, v, 1))
};

enum class AlphaMode : uint8_t { opaque, mask, blend };

struct Material {
    std::string name;
    vec4 base_color{1, 1, 1, 1}; ///< linear
    TextureUse base_color_texture;
    float metallic = 0.0f, roughness = 0.9f;
    TextureUse metallic_roughness_texture; ///< glTF packing: G roughness, B metallic
    vec3 emissive{0, 0, 0}; ///< radiance, linear
    TextureUse emissive_texture;
    AlphaMode alpha = AlphaMode::opaque;
    float alpha_cutoff = 0.5f; ///< mask: a point is there where alpha >= cutoff
    bool double_sided = false; ///< false: the camera does not see its back faces; every caster blocks light from both sides all the same
    // Glass (KHR_materials_transmission, KHR_materials_volume)
    float transmission = 0.0f;
    float thickness = 0.0f; ///< metres
    vec3 attenuation_color{1, 1, 1};
    float attenuation_distance = std::numeric_limits<float>::infinity(); ///< metres
};

/// One indexed triangle list with one material. `normals` has the size of `positions`; `uvs` and `colors` have it or are empty.
struct Mesh {
    std::string name;
    std::vector<vec3> positions; ///< object space, metres
    std::vector<vec3> normals; ///< unit, object space
    std::vector<vec2> uvs;
    std::vector<uint32_t> colors; ///< linear RGBA8, red in the lowest byte; multiplies base_color
    std::vector<uint32_t> indices; ///< a multiple of 3, each < positions.size()
    int material = 0;
    Bounds bounds; ///< of `positions`
    uint32_t absent_triangles = 0; ///< of a mesh whose vertices are on a device alone, so that the arrays are empty; `bounds` is theirs
    size_t triangle_count() const { return indices.size() / 3 + absent_triangles; }
};

/// A placed mesh. Triangle t of instance i has the scene-wide primitive id first_primitive(i) + t; see Scene::first_primitives.
struct Instance {
    int mesh = 0;
    mat4 world_from_object{1};
};

struct Scene {
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials; ///< at least one
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Light> lights; ///< the scene's own (glTF, scene JSON)
    std::vector<Camera> cameras; ///< likewise
    std::vector<std::string> warnings; ///< what the loader repaired or skipped, one sentence each
    bool tuning = false; ///< `tune` may search on it; then published tables may not use it
    bool validation = false; ///< it may decide what `tune` keeps; neither may be in tables

    Bounds bounds() const; ///< of all instances, world space
    size_t triangle_count() const; ///< as placed
    /// Running sum of triangle counts over `instances`: where each instance's primitive ids begin.
    std::vector<uint32_t> first_primitives() const;
};

/// The transmittance (1 = clear, 0 = opaque), a colour channel each, of one crossing of a surface of this material where its
/// base colour, with texture and vertex colour, is `base` (linear RGBA). Opaque: 0. Mask: 0 or 1 by the cutoff. Blend: (1 - alpha)
/// tinted by the colour, lerp(vec3(1), rgb, alpha) * (1 - alpha). Transmission: rgb * transmission, times Beer-Lambert
/// attenuation_color^(thickness / attenuation_distance). Only defined here and in shaders/material.glsl, tested against it.
vec3 transmittance(const Material&, vec4 base);

/// Makes smooth normals (area-weighted) where `normals` is empty, and bounds. Used by the loader and by the generators.
void complete(Mesh&);

} // namespace gnomon::scene
