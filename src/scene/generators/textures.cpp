// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/textures.h"

#include "scene/generators/noise.h"

#include <cmath>

namespace gnomon::scene::generators {

namespace {

float fraction(float x) { return x - std::floor(x); }
float smooth_step(float low, float high, float x)
{
    const float t = glm::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

} // namespace

Texture painted(std::string name, int size, const std::function<vec4(vec2)>& paint)
{
    Texture t;
    t.name = std::move(name);
    t.width = t.height = size;
    t.rgba.reserve(size_t(size) * size_t(size) * 4);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const vec4 c = glm::clamp(paint((vec2(float(x), float(y)) + 0.5f) / float(size)), vec4(0.0f), vec4(1.0f));
            for (int i = 0; i < 4; ++i) t.rgba.push_back(uint8_t(std::lround(c[i] * 255.0f)));
        }
    }
    return t;
}

Texture stone_blocks(std::string name, vec3 stone, vec3 mortar, int columns, int rows, uint32_t seed, float joint)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        const float y = uv.y * float(rows);
        const auto row = uint32_t(y);
        const float x = fraction(uv.x + (row & 1u ? 0.5f / float(columns) : 0.0f)) * float(columns);
        const auto column = uint32_t(x);
        const float wobble = 0.25f * (fractal_noise(uv * 24.0f, 24, 2, seed + 7) - 0.5f) * joint;
        const float edge
            = std::min(std::min(fraction(x), 1.0f - fraction(x)) * float(rows) / float(columns), std::min(fraction(y), 1.0f - fraction(y)))
            + wobble;
        const float inside = smooth_step(0.4f * joint, 1.3f * joint, edge);
        const float tone = 0.82f + 0.3f * hash01(column, row, seed);
        const float warmth = 0.06f * (hash01(column, row, seed + 1) - 0.5f);
        const float grain = 0.8f + 0.4f * fractal_noise(uv * 16.0f, 16, 4, seed + 2);
        const float rim = 0.85f + 0.15f * smooth_step(joint, 4.0f * joint, edge);
        const vec3 face = stone * tone * grain * rim + vec3(warmth, 0.0f, -warmth);
        return vec4(glm::mix(mortar * grain, face, inside), 1.0f);
    });
}

Texture mottled(std::string name, vec3 color, float contrast, int scale, uint32_t seed)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        const float coarse = fractal_noise(uv * float(scale), scale, 5, seed) - 0.5f;
        const float fine = value_noise(uv * 128.0f, 128, seed + 9) - 0.5f;
        return vec4(color * (1.0f + contrast * (1.6f * coarse + 0.35f * fine)), 1.0f);
    });
}

Texture planks(std::string name, vec3 color, int boards, uint32_t seed)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        const float x = uv.x * float(boards);
        const auto board = uint32_t(x);
        const float tone = 0.8f + 0.35f * hash01(board, seed);
        const float warp = value_noise(vec2(uv.x * 4.0f, uv.y * 4.0f), 4, seed + board);
        const float rings = 0.5f + 0.5f * std::sin((x * 9.0f + warp * 7.0f + float(board) * 2.3f) * 2.0f);
        const float fibre = value_noise(vec2(uv.x * 128.0f, uv.y * 8.0f), 128, seed + 3);
        const float gap = smooth_step(0.0f, 0.07f, std::min(fraction(x), 1.0f - fraction(x)));
        return vec4(color * tone * (0.84f + 0.1f * rings + 0.14f * fibre) * (0.55f + 0.45f * gap), 1.0f);
    });
}

Texture roof_tiles(std::string name, vec3 color, int columns, int rows, uint32_t seed)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        const float y = uv.y * float(rows);
        const auto row = uint32_t(y);
        const float x = fraction(uv.x + (row & 1u ? 0.5f / float(columns) : 0.0f)) * float(columns);
        const float fx = fraction(x) - 0.5f, fy = fraction(y);
        const float round = 0.72f + 0.35f * (1.0f - 4.0f * fx * fx);
        const float lip = 0.55f + 0.45f * smooth_step(0.0f, 0.18f, fy + 0.12f * (0.25f - fx * fx));
        const float tone = 0.8f + 0.4f * hash01(uint32_t(x), row, seed);
        const float grain = 0.85f + 0.3f * fractal_noise(uv * 16.0f, 16, 3, seed + 2);
        return vec4(color * round * lip * tone * grain, 1.0f);
    });
}

Texture striped_cloth(std::string name, vec3 a, vec3 b, int stripes, uint32_t seed)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        const float s = fraction(uv.x * float(stripes));
        const float weave = 0.94f + 0.06f * std::sin(uv.x * 256.0f * pi) * std::sin(uv.y * 256.0f * pi);
        const float wear = 0.88f + 0.24f * fractal_noise(uv * 8.0f, 8, 4, seed);
        return vec4((s < 0.5f ? a : b) * weave * wear, 1.0f);
    });
}

Texture checker_tiles(std::string name, vec3 a, vec3 b, int count, uint32_t seed)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        const vec2 t = uv * float(count);
        const auto x = uint32_t(t.x), y = uint32_t(t.y);
        const float edge = std::min(std::min(fraction(t.x), 1.0f - fraction(t.x)), std::min(fraction(t.y), 1.0f - fraction(t.y)));
        const float vein = fractal_noise(uv * 8.0f + 3.0f * hash01(x, y, seed), 8, 5, seed + 1);
        const vec3 face = ((x + y) & 1u ? a : b) * (0.86f + 0.12f * hash01(x, y, seed) + 0.2f * (vein - 0.5f));
        return vec4(face * (0.6f + 0.4f * smooth_step(0.008f, 0.03f, edge)), 1.0f);
    });
}

Texture cobbles(std::string name, vec3 stone, vec3 joint, int count, uint32_t seed)
{
    return painted(std::move(name), 256, [=](vec2 uv) {
        // Distance to the nearest and second nearest jittered centre: a Voronoi cell whose rim is the joint.
        const vec2 p = uv * float(count);
        const int cx = int(p.x), cy = int(p.y);
        float first = 9.0f, second = 9.0f, tone = 1.0f;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto ix = uint32_t((cx + dx + count) % count), iy = uint32_t((cy + dy + count) % count);
                const vec2 centre
                    = vec2(float(cx + dx), float(cy + dy)) + 0.5f + 0.55f * (vec2(hash01(ix, iy, seed), hash01(ix, iy, seed + 1)) - 0.5f);
                const float d = glm::length(p - centre);
                if (d < first)
                    second = first, first = d, tone = 0.78f + 0.4f * hash01(ix, iy, seed + 2);
                else
                    second = std::min(second, d);
            }
        }
        const float rim = smooth_step(0.03f, 0.22f, second - first);
        const float grain = 0.82f + 0.36f * fractal_noise(uv * 16.0f, 16, 4, seed + 3);
        return vec4(glm::mix(joint, stone * tone * (1.08f - 0.25f * first), rim) * grain, 1.0f);
    });
}

} // namespace gnomon::scene::generators
