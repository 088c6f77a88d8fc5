// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <cmath>

namespace gnomon::scene {

Bounds Scene::bounds() const
{
    Bounds out;
    for (const Instance& instance : instances) out.add(transformed(meshes[size_t(instance.mesh)].bounds, instance.world_from_object));
    return out;
}

size_t Scene::triangle_count() const
{
    size_t count = 0;
    for (const Instance& instance : instances) count += meshes[size_t(instance.mesh)].triangle_count();
    return count;
}

std::vector<uint32_t> Scene::first_primitives() const
{
    std::vector<uint32_t> first;
    first.reserve(instances.size());
    uint32_t next = 0;
    for (const Instance& instance : instances) {
        first.push_back(next);
        next += uint32_t(meshes[size_t(instance.mesh)].triangle_count());
    }
    return first;
}

vec3 transmittance(const Material& material, vec4 base)
{
    base = glm::clamp(base, 0.0f, 1.0f);
    const vec3 color(base.x, base.y, base.z);
    const float alpha = base.w;
    // Light that goes through the surface itself. The guard keeps pow(0, 0) out, which GLSL leaves undefined.
    vec3 glass = color * material.transmission;
    if (material.thickness > 0.0f && material.attenuation_distance < std::numeric_limits<float>::infinity())
        glass *= glm::pow(material.attenuation_color, vec3(material.thickness / material.attenuation_distance));
    switch (material.alpha) {
    case AlphaMode::mask:
        return alpha >= material.alpha_cutoff ? glass : vec3(1);
    case AlphaMode::blend:
        return glm::mix(vec3(1), color, alpha) * (1.0f - alpha) + alpha * glass;
    case AlphaMode::opaque:
        break;
    }
    return glass;
}

void complete(Mesh& mesh)
{
    mesh.bounds = {};
    for (const vec3& p : mesh.positions) mesh.bounds.add(p);
    if (!mesh.normals.empty()) return;
    // The cross product is twice the area times the normal: adding it up weights by area. In double, because the square of a
    // millimetre-sized triangle's area is near the smallest float.
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const uint32_t* corner = &mesh.indices[i];
        const glm::dvec3 a(mesh.positions[corner[0]]), b(mesh.positions[corner[1]]), c(mesh.positions[corner[2]]);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        for (int k = 0; k < 3; ++k) sums[corner[k]] += n;
    }
    mesh.normals.resize(sums.size());
    for (size_t i = 0; i < sums.size(); ++i) {
        const double length = glm::length(sums[i]);
        mesh.normals[i] = length > 0 ? vec3(sums[i] / length) : vec3(0, 1, 0);
    }
}

} // namespace gnomon::scene
