// SPDX-License-Identifier: Apache-2.0
#include "truth/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::truth {

namespace {

std::array<float, 256> make_decoded()
{
    std::array<float, 256> table;
    for (size_t i = 0; i < table.size(); ++i) {
        const double v = double(i) / 255.0;
        table[i] = float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return table;
}

int wrap(scene::Wrap mode, int64_t i, int size)
{
    const int64_t n = size;
    if (mode == scene::Wrap::clamp) return int(std::clamp<int64_t>(i, 0, n - 1));
    const int64_t period = mode == scene::Wrap::mirror ? 2 * n : n;
    const int64_t r = (i % period + period) % period;
    return int(r < n ? r : 2 * n - 1 - r);
}

/// The texels and weights of one axis.
struct Taps {
    int first, second;
    float weight; ///< of the second
};

Taps taps(float coordinate, int size, scene::Wrap mode, bool linear)
{
    // Beyond 2^30 texels a float has no fraction left; NaN falls to 0 as well.
    const float x = coordinate * float(size) - (linear ? 0.5f : 0.0f);
    if (!(std::abs(x) < 1073741824.0f)) return {0, 0, 0.0f};
    const float floor = std::floor(x);
    const auto i = int64_t(floor);
    return {wrap(mode, i, size), wrap(mode, i + 1, size), linear ? x - floor : 0.0f};
}

template <class Fetch> auto filtered(const scene::Texture& t, vec2 uv, Fetch fetch)
{
    const Taps x = taps(uv.x, t.width, t.wrap_u, t.linear), y = taps(uv.y, t.height, t.wrap_v, t.linear);
    const auto texel = [&](int column, int row) { return fetch(t.rgba.data() + (size_t(row) * size_t(t.width) + size_t(column)) * 4); };
    if (!t.linear) return texel(x.first, y.first);
    const auto top = texel(x.first, y.first) * (1.0f - x.weight) + texel(x.second, y.first) * x.weight;
    const auto bottom = texel(x.first, y.second) * (1.0f - x.weight) + texel(x.second, y.second) * x.weight;
    return top * (1.0f - y.weight) + bottom * y.weight;
}

struct Corners {
    uint32_t index[3];
    float weight[3];
};

Corners corners(const scene::Mesh& mesh, uint32_t triangle, float u, float v)
{
    const uint32_t* i = mesh.indices.data() + size_t(triangle) * 3;
    return {{i[0], i[1], i[2]}, {1.0f - u - v, u, v}};
}

vec2 texture_coordinates(const Surface& s, const Corners& c)
{
    vec2 uv(0.0f);
    if (!s.mesh->uvs.empty())
        for (int k = 0; k < 3; ++k) uv += c.weight[k] * s.mesh->uvs[c.index[k]];
    const scene::TextureUse& use = s.material->base_color_texture;
    return {glm::dot(use.u_row, vec3(uv, 1.0f)), glm::dot(use.v_row, vec3(uv, 1.0f))};
}

const scene::Texture* base_texture(const Surface& s)
{
    const int index = s.material->base_color_texture.texture;
    if (index < 0 || size_t(index) >= s.scene->textures.size()) return nullptr;
    const scene::Texture& t = s.scene->textures[size_t(index)];
    return t.rgba.empty() ? nullptr : &t;
}

} // namespace

vec4 sample(const scene::Texture& t, vec2 uv)
{
    static const std::array<float, 256> decoded = make_decoded();
    const auto plain = [](uint8_t v) { return float(v) / 255.0f; };
    if (!t.srgb) return filtered(t, uv, [&](const uint8_t* p) { return vec4(plain(p[0]), plain(p[1]), plain(p[2]), plain(p[3])); });
    return filtered(t, uv, [&](const uint8_t* p) { return vec4(decoded[p[0]], decoded[p[1]], decoded[p[2]], plain(p[3])); });
}

vec4 base_color(const Surface& s, uint32_t triangle, float u, float v)
{
    const Corners c = corners(*s.mesh, triangle, u, v);
    vec4 color = s.material->base_color;
    if (const scene::Texture* t = base_texture(s)) color *= sample(*t, texture_coordinates(s, c));
    if (s.mesh->colors.empty()) return color;
    vec4 vertex(0.0f);
    for (int k = 0; k < 3; ++k) {
        const uint32_t rgba = s.mesh->colors[c.index[k]];
        vertex += c.weight[k] / 255.0f * vec4(rgba & 255u, (rgba >> 8) & 255u, (rgba >> 16) & 255u, rgba >> 24);
    }
    return color * vertex;
}

float alpha(const Surface& s, uint32_t triangle, float u, float v)
{
    const Corners c = corners(*s.mesh, triangle, u, v);
    float a = s.material->base_color.w;
    if (const scene::Texture* t = base_texture(s))
        a *= filtered(*t, texture_coordinates(s, c), [](const uint8_t* p) { return float(p[3]) / 255.0f; });
    if (s.mesh->colors.empty()) return a;
    float vertex = 0.0f;
    for (int k = 0; k < 3; ++k) vertex += c.weight[k] / 255.0f * float(s.mesh->colors[c.index[k]] >> 24);
    return a * vertex;
}

} // namespace gnomon::truth
