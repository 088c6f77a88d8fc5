// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gnomon::scene {

/// What of all that the rest of the program relies on does not hold of a loaded scene; empty where all does.
inline std::string_view unsound(const Scene& scene)
{
    if (scene.materials.empty()) return "a scene has a material";
    if (scene.instances.empty()) return "a scene shows something";
    const auto finite = [](vec3 p) { return std::isfinite(p.x + p.y + p.z); };
    for (const Mesh& mesh : scene.meshes) {
        const size_t vertices = mesh.positions.size();
        if (mesh.normals.size() != vertices) return "every vertex has a normal";
        if (!mesh.uvs.empty() && mesh.uvs.size() != vertices) return "every vertex has texture coordinates, or none has";
        if (!mesh.colors.empty() && mesh.colors.size() != vertices) return "every vertex has a colour, or none has";
        if (mesh.indices.size() % 3 != 0) return "a mesh has whole triangles";
        if (mesh.material < 0 || size_t(mesh.material) >= scene.materials.size()) return "a mesh has a material that exists";
        if (std::ranges::any_of(mesh.indices, [&](uint32_t i) { return i >= vertices; })) return "a triangle has corners that exist";
        if (!std::ranges::all_of(mesh.positions, finite)) return "positions are finite";
        if (std::ranges::any_of(mesh.normals, [](vec3 n) { return !(std::abs(glm::length(n) - 1.0f) <= 1e-3f); }))
            return "normals are unit";
    }
    for (const Instance& instance : scene.instances) {
        if (instance.mesh < 0 || size_t(instance.mesh) >= scene.meshes.size()) return "an instance has a mesh that exists";
        if (!(glm::determinant(mat3(instance.world_from_object)) > 0.0f)) return "an instance is neither flat nor mirrored";
    }
    const int textures = int(scene.textures.size());
    for (const Material& m : scene.materials)
        for (const TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture, &m.emissive_texture})
            if (use->texture >= textures) return "a material has textures that exist";
    for (const Texture& t : scene.textures)
        if (t.width < 1 || t.height < 1 || t.rgba.size() != size_t(t.width) * size_t(t.height) * 4) return "a texture has all its texels";
    if (!std::isfinite(scene.bounds().radius())) return "a scene ends somewhere";
    return {};
}

} // namespace gnomon::scene
