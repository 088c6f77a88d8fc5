// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/fit_point.h"

#include "shadow/parts/clip.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

/// One perspective layer: reversed depth with both planes fitted to the scene. `tangent`: of the half angle; `centre`: of the square that
/// it sees one metre before the light.
shaders::LightMapLayer perspective_layer(const mat4& axes, float tangent, float near, float far, int size, vec2 centre = vec2(0))
{
    shaders::LightMapLayer layer{};
    layer.perspective = 1, layer.near = near, layer.far = far;
    mat4 clip(0);
    clip[0][0] = clip[1][1] = 1.0f / tangent;
    clip[2][0] = -centre.x / tangent, clip[2][1] = -centre.y / tangent;
    clip[2][2] = -near / (far - near), clip[3][2] = near * far / (far - near);
    clip[2][3] = 1.0f;
    layer.map_from_world = uv_from_clip() * clip * axes;
    layer.depth_plane = row(axes, 2);
    layer.axis_uv = 0.5f + 0.5f * vec2(-centre.x, centre.y) / tangent;
    layer.texel_metres = 2.0f * tangent / float(size);
    layer.texel_uv = 1.0f / float(size);
    return layer;
}

/// Depths between which anything can cast or receive, for a light at `position` and layers that reach as far from their axis as `cosine`.
void depth_range(const Bounds& bounds, vec3 position, float cosine, float& near, float& far)
{
    far = 0;
    for (const vec3 c : corners(bounds)) far = std::max(far, glm::length(c - position));
    far = std::max(far, 1e-3f) * 1.01f;
    const vec3 nearest = glm::clamp(position, bounds.min, bounds.max);
    // inside the scene nothing bounds it: float depth reversed loses no precision to a small near plane
    near = std::max(cosine * glm::length(nearest - position), 2e-4f * far);
}

/// Of a cube's corner, less something for the rim (1 / sqrt(3) without), and of spots of up to 60 degrees.
constexpr float cube_cosine = 0.5f;

/// Of a square pyramid's corner, with something to spare.
float corner_cosine(float tangent) { return 0.99f / std::sqrt(1.0f + 2.0f * tangent * tangent); }

/// A face of 90 degrees plus a rim of guard texels: tan = 1 on (size - 2 guard) texels.
float face_tangent(const LightMapSettings& settings)
{
    return float(settings.size) / std::max(float(settings.size) - 2.0f * settings.guard_texels, 1.0f);
}

mat4 face_axes(vec3 position, const mat3& axes, int face)
{
    return light_axes(position, axes[face / 2] * (face % 2 ? -1.0f : 1.0f), axes[face / 2 == 1 ? 0 : 1]);
}

/// Four faces of a tetrahedron about the light, the fewest layers that see all around (Fortes 2000). One metre before the light a face is
/// an equilateral triangle with an inscribed circle of radius sqrt(2) and sides of 2 sqrt(6). Upright it takes a square of its side; turned
/// by 15 degrees, one corner in the square's and the sides from it symmetric to the diagonal, one of cos(15 degrees) = 0.966 of that, the
/// smallest. The axis then lies 2 m from both sides at that corner, off the square's centre.
void fit_tetrahedron(shaders::LightMap& map, const Bounds& bounds, vec3 position, const LightMapSettings& settings)
{
    const float side = 2.0f * std::sqrt(6.0f) * std::cos(pi / 12.0f);
    // the corners of the triangle are at a cosine of 1 / 3, those of the square at 1 / 4, and the guard is beyond
    float near, far;
    depth_range(bounds, position, 0.2f, near, far);
    constexpr vec3 faces[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    map.layout_kind = LIGHT_MAP_TETRAHEDRON, map.layer_count = 4, map.centre = position, map.axes = mat3(1);
    for (size_t face = 0; face < 4; ++face) {
        const vec3 z = glm::normalize(faces[face]), next = glm::normalize(faces[(face + 1) % 4]);
        // a corner lies opposite to another face's axis
        const vec3 e = glm::normalize(next - glm::dot(next, z) * z), f = glm::cross(e, z);
        const vec3 x = glm::normalize(e - f), y = glm::normalize(e + f);
        mat4 axes(1);
        for (int c = 0; c < 3; ++c) axes[c] = vec4(x[c], y[c], z[c], 0);
        axes[3] = vec4(-glm::dot(x, position), -glm::dot(y, position), -glm::dot(z, position), 1);
        map.layers[face]
            = perspective_layer(axes, 0.5f * side * face_tangent(settings), near, far, settings.size, vec2(0.5f * side - 2.0f));
    }
}

/// Two paraboloids along -y and y. On the rim between them a texel is half as wide as on the axis, in angle: the densest place is where
/// both meet. The square's corners look back past the rim, so that filters find their texels there.
void fit_dual_paraboloid(shaders::LightMap& map, const Bounds& bounds, vec3 position, const LightMapSettings& settings)
{
    map.layout_kind = LIGHT_MAP_DUAL_PARABOLOID, map.layer_count = 2, map.centre = position, map.axes = mat3(1);
    const float scale = 0.5f / face_tangent(settings);
    for (int side = 0; side < 2; ++side) {
        const mat4 axes = light_axes(position, vec3(0, side == 0 ? -1 : 1, 0), vec3(1, 0, 0));
        shaders::LightMapLayer& layer = map.layers[side];
        layer = {};
        layer.perspective = 1, layer.warped = 2;
        depth_range(bounds, position, 1.0f, layer.near, layer.far);
        mat4 rows(0);
        rows[0][0] = scale, rows[1][1] = -scale, rows[2][2] = 1.0f, rows[3][3] = scale;
        layer.map_from_world = rows * axes;
        layer.depth_plane = row(axes, 2);
        layer.texel_uv = 1.0f / float(settings.size);
        // on the rim: |dq| is the angle there, half of it on the axis
        layer.texel_metres = 1.0f / (scale * float(settings.size));
    }
}

/// Whether all points lie behind a layer's eye or outside of one of the sides of its pyramid of 90 degrees.
bool misses_face(const std::vector<vec3>& points, const mat4& axes)
{
    bool behind = true, left = true, right = true, below = true, above = true;
    for (const vec3 p : points) {
        const vec3 q(axes * vec4(p, 1));
        behind = behind && q.z < 0.0f;
        left = left && q.x < -q.z, right = right && q.x > q.z;
        below = below && q.y < -q.z, above = above && q.y > q.z;
    }
    return behind || left || right || below || above;
}

/// The axes of a single perspective layer around `receivers`, and the tangent of its half angle: 0 where one lies beside or behind.
mat4 centred_axes(vec3 position, const std::vector<vec3>& receivers, float& tangent)
{
    Bounds hull;
    for (const vec3 p : receivers) hull.add(p);
    vec3 direction = hull.centre() - position;
    mat4 axes(1);
    for (int turn = 0; turn < 4; ++turn) { // each centres the axis better
        tangent = 0.0f;
        if (glm::length(direction) < 1e-6f * hull.radius()) return axes;
        axes = light_axes(position, glm::normalize(direction), vec3(0, 1, 0));
        vec2 least(1e30f), most(-1e30f);
        for (const vec3 p : receivers) {
            const vec3 q(axes * vec4(p, 1));
            if (q.z <= 0.05f * glm::length(q)) return axes;
            least = glm::min(least, vec2(q) / q.z), most = glm::max(most, vec2(q) / q.z);
        }
        tangent = std::max({-least.x, -least.y, most.x, most.y});
        direction = glm::transpose(mat3(axes)) * vec3(0.5f * (least + most), 1.0f);
    }
    return axes;
}

} // namespace

void fit_cube(shaders::LightMap& map, const Bounds& bounds, vec3 position, const mat3& axes, const LightMapSettings& settings)
{
    float near, far;
    depth_range(bounds, position, cube_cosine, near, far);
    map.layout_kind = LIGHT_MAP_CUBE, map.layer_count = 6, map.centre = position, map.axes = axes;
    for (int face = 0; face < 6; ++face)
        map.layers[face] = perspective_layer(face_axes(position, axes, face), face_tangent(settings), near, far, settings.size);
}

void fit_point(shaders::LightMap& map, const Bounds& bounds, vec3 position, const LightMapSettings& settings)
{
    if (PointLayout(settings.fitting.point_layout) == PointLayout::dual_paraboloid)
        fit_dual_paraboloid(map, bounds, position, settings);
    else if (PointLayout(settings.fitting.point_layout) == PointLayout::tetrahedron)
        fit_tetrahedron(map, bounds, position, settings);
    else
        fit_cube(map, bounds, position, mat3(1), settings);
}

PointFit fit_point_layers(vec3 position, const std::vector<vec3>& receivers, const Bounds& casters, const LightMapSettings& settings)
{
    constexpr float widest = 2.0f;
    PointFit fit;
    float near, far, tangent;
    const mat4 axes = centred_axes(position, receivers, tangent);
    if (tangent > 0.0f && tangent <= widest) {
        tangent = std::max(tangent, 1e-4f) * rim_factor(settings);
        depth_range(casters, position, corner_cosine(tangent), near, far);
        return {{perspective_layer(axes, tangent, near, far, settings.size)}, {-1}};
    }
    depth_range(casters, position, cube_cosine, near, far);
    for (int face = 0; face < 6; ++face) {
        const mat4 at_face = face_axes(position, mat3(1), face);
        if (misses_face(receivers, at_face)) continue;
        fit.layers.push_back(perspective_layer(at_face, face_tangent(settings), near, far, settings.size));
        fit.faces.push_back(face);
    }
    return fit;
}

std::vector<vec3> fit_spot(
    shaders::LightMap& map, const Bounds& bounds, const scene::View& view, const scene::SpotLight& spot, const LightMapSettings& settings)
{
    float near, far;
    depth_range(bounds, spot.position, cube_cosine, near, far);
    mat4 axes = light_axes(spot.position, spot.direction, vec3(0, 1, 0));
    float tangent = std::tan(spot.outer_angle);
    std::vector<vec3> receivers;
    if (Fit(settings.fitting.fit) != Fit::uniform) receivers = visible_part(view, bounds, spot, near * std::cos(spot.outer_angle));
    if (!receivers.empty()) { // turned to what is seen, where that is less than the cone
        float seen;
        const mat4 turned = centred_axes(spot.position, receivers, seen);
        if (seen > 0.0f && seen < tangent) {
            axes = turned, tangent = std::max(seen, 1e-4f);
            depth_range(bounds, spot.position, corner_cosine(tangent * rim_factor(settings)), near, far);
        }
    }
    map.layer_count = 1, map.centre = spot.position;
    map.layers[0] = perspective_layer(axes, tangent * rim_factor(settings), near, far, settings.size);
    return receivers;
}

} // namespace gnomon::shadow::parts
