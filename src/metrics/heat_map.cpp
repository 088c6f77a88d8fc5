// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "metrics/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace gnomon::metrics {

namespace {

using Rgb = std::array<float, 3>;

constexpr Rgb rgb(int hex) { return {float((hex >> 16) & 255) / 255.0f, float((hex >> 8) & 255) / 255.0f, float(hex & 255) / 255.0f}; }

/// ColorBrewer's RdBu (C. Brewer), which those who cannot tell red from green can read too.
constexpr std::array<Rgb, 4> dark{rgb(0xffffff), rgb(0x92c5de), rgb(0x2166ac), rgb(0x053061)};
constexpr std::array<Rgb, 4> light{rgb(0xffffff), rgb(0xf4a582), rgb(0xb2182b), rgb(0x67001f)};
constexpr Rgb not_scored = rgb(0x9a9a9a), ink = rgb(0x202020), paper = rgb(0xffffff);

/// `t` in [-1, 1].
Rgb color(float t)
{
    const auto& ramp = t < 0.0f ? dark : light;
    const float at = std::min(std::abs(t), 1.0f) * float(ramp.size() - 1);
    const size_t i = std::min(size_t(at), ramp.size() - 2);
    const float f = at - float(i);
    Rgb c;
    for (size_t k = 0; k < 3; ++k) c[k] = ramp[i][k] * (1.0f - f) + ramp[i + 1][k] * f;
    return c;
}

void put(base::Picture& p, int x, int y, const Rgb& c)
{
    if (x < 0 || y < 0 || x >= p.size.width || y >= p.size.height) return;
    for (int k = 0; k < 3; ++k) p.at(x, y, k) = c[size_t(k)];
}

constexpr int glyph_width = 5, glyph_height = 7, glyph_step = 6;

/// Rows from the top, five bits each, the leftmost pixel highest.
std::array<int, glyph_height> glyph(char c)
{
    switch (c) {
    case '0':
        return {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e};
    case '1':
        return {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e};
    case '2':
        return {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f};
    case '3':
        return {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e};
    case '4':
        return {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02};
    case '5':
        return {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e};
    case '6':
        return {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e};
    case '7':
        return {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08};
    case '8':
        return {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e};
    case '9':
        return {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c};
    case '-':
        return {0x00, 0x00, 0x00, 0x1f, 0x00, 0x00, 0x00};
    case '+':
        return {0x00, 0x04, 0x04, 0x1f, 0x04, 0x04, 0x00};
    case '.':
        return {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c};
    case 'e':
        return {0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e};
    default:
        return {};
    }
}

int text_width(const std::string& text) { return int(text.size()) * glyph_step - 1; }

void write(base::Picture& p, int x, int y, const std::string& text)
{
    for (const char c : text) {
        const auto rows = glyph(c);
        for (int v = 0; v < glyph_height; ++v)
            for (int u = 0; u < glyph_width; ++u)
                if (rows[size_t(v)] >> (glyph_width - 1 - u) & 1) put(p, x + u, y + v, ink);
        x += glyph_step;
    }
}

constexpr int gap = 4, bar = 10, tick = 3, legend_height = gap + bar + tick + 2 + glyph_height + gap;

/// The ramp with ticks at -range, -range/2, 0, range/2, range, as many of them labelled as have room.
void draw_legend(base::Picture& p, int top, float range)
{
    const int left = 2 * gap, right = p.size.width - 1 - 2 * gap, width = right - left;
    if (width < 8) return;
    for (int x = left; x <= right; ++x) {
        const Rgb c = color(2.0f * float(x - left) / float(width) - 1.0f);
        for (int y = 0; y < bar; ++y) put(p, x, top + gap + y, y == 0 || y == bar - 1 || x == left || x == right ? ink : c);
    }
    int free_from = 0;
    const int step = width >= 200 ? 1 : 2;
    for (int i = 0; i <= 4; i += step) {
        const int x = left + width * i / 4;
        for (int y = 0; y < tick; ++y) put(p, x, top + gap + bar + y, ink);
        const float value = range * (0.5f * float(i) - 1.0f);
        const std::string label = i == 2 ? "0" : fmt::format("{:+.3g}", value);
        const int w = text_width(label), at = std::clamp(x - w / 2, 0, std::max(0, p.size.width - w));
        if (at < free_from || at + w > p.size.width) continue;
        write(p, at, top + gap + bar + tick + 2, label);
        free_from = at + w + glyph_step;
    }
}

} // namespace

std::vector<std::string> heat_map_colors()
{
    std::vector<std::string> out;
    for (int i = -3; i <= 3; ++i) {
        const Rgb c = color(float(i) / 3.0f);
        const auto byte = [](float v) { return int(std::lround(v * 255.0f)); };
        out.push_back(fmt::format("#{:02x}{:02x}{:02x}", byte(c[0]), byte(c[1]), byte(c[2])));
    }
    return out;
}

base::Picture signed_heat_map(const Comparison& c, float range)
{
    if (!(range > 0.0f)) base::fail("the range of a heat map must be above 0, not {}", range);
    const Grey g(c);
    const auto [width, height] = c.truth.size;
    base::Picture map({width, height + legend_height}, 3);
    for (int y = 0; y < map.size.height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t i = size_t(y) * size_t(width) + size_t(x);
            put(map, x, y, y >= height ? paper : g.scored(i) ? color(g.difference(i) / range) : not_scored);
        }
    draw_legend(map, height, range);
    return map;
}

} // namespace gnomon::metrics
