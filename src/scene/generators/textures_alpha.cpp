// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/noise.h"
#include "scene/generators/textures.h"

#include <cmath>
#include <vector>

namespace gnomon::scene::generators {

namespace {

struct Leaf {
    vec2 foot, along; ///< texture coordinates; |along| is the length
    float width, tone;
};

/// Position within a leaf: x in [-1, 1] across at its widest, y from 0 at the foot to 1 at the tip.
vec2 in_leaf(const Leaf& leaf, vec2 p)
{
    const float length = glm::length(leaf.along);
    const vec2 axis = leaf.along / length;
    const vec2 d = p - leaf.foot;
    return vec2((d.x * axis.y - d.y * axis.x) / leaf.width, glm::dot(d, axis) / length);
}

float leaf_outline(float y) { return y <= 0.0f || y >= 1.0f ? 0.0f : std::pow(std::sin(pi * std::pow(y, 0.75f)), 0.8f); }

} // namespace

Texture leaf_spray(std::string name, vec3 color, uint32_t seed)
{
    std::vector<Leaf> leaves;
    Random random(seed);
    for (int i = 0; i < 15; ++i) {
        const float t = 0.06f + 0.82f * float(i) / 14.0f;
        const float side = i == 14 ? 0.0f : i & 1 ? 1.0f : -1.0f;
        const float angle = side * random.between(0.7f, 1.25f);
        const float length = random.between(0.24f, 0.34f) * (1.05f - 0.4f * t);
        leaves.push_back({vec2(0.5f + 0.02f * side, 0.98f - 0.8f * t), length * vec2(std::sin(angle), -std::cos(angle)), 0.3f * length,
            random.between(0.75f, 1.2f)});
    }
    return painted(std::move(name), 256, [=](vec2 uv) {
        vec4 result(color * 0.7f, 0.0f); // the colour under alpha 0 keeps filtering from drawing a dark rim
        const float stem = std::abs(uv.x - 0.5f - 0.015f * std::sin(uv.y * 9.0f));
        if (stem < 0.008f && uv.y > 0.18f) result = vec4(0.36f, 0.3f, 0.18f, 1.0f);
        for (const Leaf& leaf : leaves) {
            const vec2 q = in_leaf(leaf, uv);
            if (std::abs(q.x) > leaf_outline(q.y)) continue;
            const float vein = std::abs(q.x) < 0.07f || std::abs(std::sin(14.0f * (q.y - 0.5f * std::abs(q.x)))) < 0.1f ? 1.14f : 1.0f;
            result = vec4(color * leaf.tone * vein * (0.85f + 0.3f * q.y), 1.0f);
        }
        return result;
    });
}

Texture grass_blades(std::string name, vec3 color, uint32_t seed)
{
    struct Blade {
        float x, lean, height, width, tone;
    };
    std::vector<Blade> blades;
    Random random(seed);
    for (int i = 0; i < 26; ++i)
        blades.push_back({random.next(), random.between(-0.16f, 0.16f), random.between(0.4f, 0.97f), random.between(0.012f, 0.024f),
            random.between(0.7f, 1.25f)});
    return painted(std::move(name), 256, [=](vec2 uv) {
        vec4 result(color * 0.8f, 0.0f);
        for (const Blade& b : blades) {
            const float t = (1.0f - uv.y) / b.height;
            if (t > 1.0f) continue;
            float d = std::abs(uv.x - b.x - b.lean * t * t);
            d = std::min(d, 1.0f - d);
            if (d < b.width * (1.0f - 0.9f * t * t)) result = vec4(color * b.tone * (0.6f + 0.55f * t), 1.0f);
        }
        return result;
    });
}

Texture chain_link(std::string name, vec3 wire, int cells)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        const vec2 p = uv * float(cells);
        // Distances from the two families of diagonals, in cells.
        const auto distance = [](float t) { return std::abs(t - std::floor(t + 0.5f)) * 0.70711f; };
        const float d0 = distance(p.x + p.y), d1 = distance(p.x - p.y);
        const float d = std::min(d0, d1), radius = 0.085f;
        const float shade = std::sqrt(std::max(0.0f, 1.0f - d * d / (radius * radius)));
        const bool over = (int(std::floor(p.x + 0.25f)) + int(std::floor(p.y + 0.25f))) & 1;
        return vec4(wire * (0.55f + 0.45f * shade) * (over == (d0 < d1) ? 1.0f : 0.85f), d < radius ? 1.0f : 0.0f);
    });
}

} // namespace gnomon::scene::generators
