// SPDX-License-Identifier: Apache-2.0
#include "scene/rebase.h"

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

constexpr float far_radii = 16.0f; // four of the 24 bits

/// The multiple of a power of two, of the radius or more, that is nearest to each coordinate.
vec3 coarse(vec3 v, float radius)
{
    const float step = std::exp2(std::ceil(std::log2(std::max(radius, 1e-6f))));
    return step * glm::round(v / step);
}

bool finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Of a mesh: only along axes where its coordinates are far, since elsewhere a difference would be rounded anew.
vec3 mesh_origin(const Mesh& mesh)
{
    if (mesh.bounds.empty()) return vec3(0);
    const float radius = mesh.bounds.radius();
    const vec3 centre = mesh.bounds.centre();
    const vec3 out = coarse(centre, radius);
    vec3 used(0);
    for (int i = 0; i < 3; ++i)
        if (std::abs(centre[i]) > far_radii * radius) used[i] = out[i];
    return finite(used) ? used : vec3(0);
}

struct Mover {
    vec3 origin;
    void operator()(DirectionalLight&) const { }
    void operator()(SpotLight& l) const { l.position -= origin; }
    void operator()(PointLight& l) const { l.position -= origin; }
    void operator()(RectLight& l) const { l.centre -= origin; }
    void operator()(DiskLight& l) const { l.centre -= origin; }
};

} // namespace

vec3 far_origin(const Scene& scene)
{
    const Bounds bounds = scene.bounds();
    if (bounds.empty()) return vec3(0);
    const float radius = bounds.radius();
    const vec3 centre = bounds.centre(), out = coarse(centre, radius);
    const float distance = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
    return distance > far_radii * radius && finite(out) ? out : vec3(0);
}

void rebase(Scene& scene, vec3 origin)
{
    if (origin == vec3(0)) return;
    std::vector<vec3> moved;
    for (Mesh& mesh : scene.meshes) {
        const vec3 own = mesh_origin(mesh);
        moved.push_back(own);
        if (own == vec3(0)) continue;
        for (vec3& p : mesh.positions) p -= own;
        mesh.bounds.min -= own, mesh.bounds.max -= own;
    }
    for (Instance& instance : scene.instances) {
        const glm::dmat4 m(instance.world_from_object);
        const glm::dvec4 at = m * glm::dvec4(glm::dvec3(moved[size_t(instance.mesh)]), 1.0) - glm::dvec4(glm::dvec3(origin), 0.0);
        instance.world_from_object[3] = vec4(at);
    }
    for (Light& light : scene.lights) std::visit(Mover{origin}, light.shape);
    for (Camera& camera : scene.cameras) camera.eye -= origin, camera.target -= origin;
}

} // namespace gnomon::scene
