// SPDX-License-Identifier: Apache-2.0
#include "techniques/virtual_shadow_map/virtual_grid.h"

#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace gnomon::techniques::virtual_shadow_map {

namespace {

using namespace shadow;

/// Finest virtual map, as a power of two: coordinates have 24 bits.
constexpr int finest_bits = 24;
/// Metres. No receiver is looked at so closely that it needs finer texels, and each level takes room in the table.
constexpr float finest_texel = 1e-4f;

float power_above(float v) { return std::exp2(std::ceil(std::log2(std::max(v, 1e-6f)))); }

/// A range that begins at or before `from`: its length a power of two, its beginning a multiple of an eighth of that, so that objects which
/// move about in the scene leave it as it is.
vec2 steady_range(float from, float length)
{
    const float step = length / 8.0f;
    return vec2(std::floor(from / step) * step, std::floor(from / step) * step + length);
}

float steady_length(float length) { return power_above(std::max(length, 1e-4f) * 8.0f / 7.0f); }

void fit_directional(Grid& grid, const Bounds& bounds, vec3 direction)
{
    // Axes through the world's origin would round to millionths of the way there.
    const float coarse = 4.0f * power_above(bounds.radius());
    const mat4 axes = parts::light_axes(glm::round(bounds.centre() / coarse) * coarse, direction, vec3(0, 1, 0));
    Bounds box;
    for (const vec3 p : parts::corners(bounds)) box.add(vec3(axes * vec4(p, 1)));
    const vec3 sides = box.max - box.min;
    const float width = steady_length(std::max(sides.x, sides.y));
    const vec2 x = steady_range(box.min.x, width), y = steady_range(box.min.y, width);
    const vec2 z = steady_range(box.min.z, steady_length(sides.z));
    grid.layout_kind = LIGHT_MAP_SINGLE, grid.faces = 1;
    LightMapLayer& face = grid.face[0];
    face = parts::orthographic_layer(axes, vec2(0), width, z, z, grid.page);
    // v is down and y up
    grid.offset = vec2(-x[0] / width, y[1] / width);
    face.map_from_world[3].x -= 0.5f, face.map_from_world[3].y -= 0.5f;
}

/// Planes of a light at `position`, in powers of two like a directional light's frame.
void depth_range(const Bounds& bounds, vec3 position, float cosine, float& near, float& far)
{
    far = 0;
    for (const vec3 c : parts::corners(bounds)) far = std::max(far, glm::length(c - position));
    far = power_above(far * 1.01f);
    const vec3 nearest = glm::clamp(position, bounds.min, bounds.max);
    near = std::max(0.5f * power_above(cosine * glm::length(nearest - position)), far / 8192.0f);
}

LightMapLayer perspective_face(const mat4& axes, float tangent, float near, float far, int page)
{
    mat4 map(0); // to (u w, v w, z w, w), v down
    map[0][0] = 0.5f / tangent, map[1][1] = -0.5f / tangent;
    map[2] = vec4(0.5f, 0.5f, -near / (far - near), 1);
    map[3][2] = near * far / (far - near);
    LightMapLayer layer{};
    layer.perspective = 1, layer.near = near, layer.far = far;
    layer.map_from_world = map * axes;
    layer.depth_plane = vec4(axes[0][2], axes[1][2], axes[2][2], axes[3][2]);
    layer.texel_metres = 2.0f * tangent / float(page);
    return layer;
}

void fit_point(Grid& grid, const Bounds& bounds, vec3 position)
{
    float near, far;
    depth_range(bounds, position, 0.5f, near, far);
    grid.layout_kind = LIGHT_MAP_CUBE, grid.faces = 6, grid.centre = position;
    for (int face = 0; face < 6; ++face) {
        vec3 direction(0);
        direction[face / 2] = face % 2 ? -1.0f : 1.0f;
        grid.face[face] = perspective_face(
            parts::light_axes(position, direction, face / 2 == 1 ? vec3(1, 0, 0) : vec3(0, 1, 0)), 1.0f, near, far, grid.page);
    }
}

void fit_spot(Grid& grid, const Bounds& bounds, const scene::SpotLight& spot)
{
    if (spot.outer_angle > pi / 3.0f) {
        fit_point(grid, bounds, spot.position);
        return;
    }
    float near, far;
    depth_range(bounds, spot.position, std::cos(spot.outer_angle), near, far);
    grid.layout_kind = LIGHT_MAP_SINGLE, grid.faces = 1;
    grid.face[0] = perspective_face(parts::light_axes(spot.position, spot.direction, vec3(0, 1, 0)),
        std::tan(std::max(spot.outer_angle, 1e-3f)) * 1.001f, near, far, grid.page);
}

/// What the view sees of the scene.
struct Seen {
    const scene::View& view;
    vec3 forward, centre;
    float farthest; ///< along the view's axis
    float pixel; ///< its width at 1 m
    int page; ///< texels
};

Seen seen_by(const scene::View& view, const Bounds& bounds, int page)
{
    const float pixel = 2.0f / (std::abs(view.clip_from_view[1][1]) * float(view.size.height));
    Seen out{view, parts::forward_of(view), view.eye, view.near, pixel, page};
    Bounds box;
    for (const vec3 p : parts::visible_part(view, bounds)) {
        out.farthest = std::max(out.farthest, glm::dot(p - view.eye, out.forward));
        box.add(p);
    }
    if (!box.empty()) out.centre = box.centre();
    return out;
}

/// On the face, the middle of the samples that need a level: from where its texels are as wide as a pixel, and as far beyond as a window
/// reaches, since receivers that graze the light need finer texels. With its middle at 0.6 of its half width before the eye, what a view
/// of 80 degrees sees at 1.2 half widths is inside.
vec2 centre_of_level(const Grid& grid, const Seen& seen, int level, int side)
{
    const float page = grid.face[0].texel_metres * float(seen.page) / float(1 << level); // metres
    const float away = std::max(page / float(seen.page) / seen.pixel, 0.3f * page * float(side));
    const vec3 p = seen.view.orthographic ? seen.centre : seen.view.eye + seen.forward * std::min(away, seen.farthest);
    return glm::clamp(vec2(grid.face[0].map_from_world * vec4(p, 1)) + grid.offset, vec2(0), vec2(1));
}

void place_windows(Grid& grid, const scene::View& view, const Bounds& bounds)
{
    const auto fit = [](float desired, int least, int most) { return std::clamp(int(std::floor(desired)), least, most); };
    const Seen seen = seen_by(view, bounds, grid.page);
    for (int l = grid.levels - 1; l >= 0; --l) {
        Level& level = grid.level[l];
        const int pages = 1 << l, side = level.side;
        if (side == pages) continue;
        const vec2 start = centre_of_level(grid, seen, l, side) * float(pages) - 0.5f * float(side);
        // A window holds all of the next finer one, so that a page's ancestors are always in the table.
        int least_x = 0, most_x = pages - side, least_y = 0, most_y = pages - side;
        if (l + 1 < grid.levels) {
            const Level& finer = grid.level[l + 1];
            least_x = std::max(0, (finer.window_x + finer.side - 1) / 2 - side + 1), most_x = std::min(most_x, finer.window_x / 2);
            least_y = std::max(0, (finer.window_y + finer.side - 1) / 2 - side + 1), most_y = std::min(most_y, finer.window_y / 2);
        }
        level.window_x = fit(start.x, least_x, most_x);
        level.window_y = fit(start.y, least_y, most_y);
    }
}

} // namespace

int filter_border(const Params& p) { return (p.pcf + 1) / 2 + 2; }

Grid fit_grid(const scene::View& view, const Bounds& bounds, const scene::Light& light, const Params& params, int pool)
{
    Grid grid{};
    grid.page = 64 << params.page;
    grid.border = filter_border(params);
    grid.pool = pool;
    const int page_bits = 6 + params.page, side_bits = 10 + params.virtual_size - page_bits;
    const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape);
    if (sun)
        fit_directional(grid, bounds, sun->direction);
    else if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape))
        fit_spot(grid, bounds, *spot);
    else
        fit_point(grid, bounds, std::get<scene::PointLight>(light.shape).position);
    const int useful = int(std::log2(std::max(grid.face[0].texel_metres / finest_texel, 1.0f)));
    const int finest = std::min(
        {side_bits + (sun ? std::clamp(useful - side_bits, 0, params.finer_levels) : 0), finest_bits - page_bits, VIRTUAL_LEVELS - 1});
    grid.levels = finest + 1;
    for (int l = 0; l < grid.levels; ++l) {
        const int side = 1 << std::min(l, side_bits);
        grid.level[l] = {grid.face_entries, side, 0, 0};
        grid.face_entries += uint32_t(side * side);
    }
    grid.entries = grid.face_entries * uint32_t(grid.faces);
    place_windows(grid, view, bounds);
    return grid;
}

bool same_pages(const Grid& a, const Grid& b)
{
    Grid x = a, y = b;
    std::fill(std::begin(x.level), std::end(x.level), Level{});
    std::fill(std::begin(y.level), std::end(y.level), Level{});
    return std::memcmp(&x, &y, sizeof(Grid)) == 0;
}

} // namespace gnomon::techniques::virtual_shadow_map
