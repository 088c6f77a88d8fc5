// SPDX-License-Identifier: Apache-2.0
// Where the pages of a virtual shadow map lie: fixed in the world, whatever the view.
#include "techniques/virtual_shadow_map/virtual_grid.h"

#include "scene/light.h"

#include <gtest/gtest.h>

#include <random>

namespace gnomon::techniques::virtual_shadow_map {
namespace {

struct Random {
    std::mt19937 generator{7};
    float operator()(float from, float to) { return std::uniform_real_distribution<float>(from, to)(generator); }
    vec3 point(float size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
};

scene::Light sun(vec3 direction)
{
    scene::Light light;
    light.shape = scene::DirectionalLight{.direction = glm::normalize(direction)};
    return light;
}

TEST(VirtualGrid, WindowsHoldThoseOfFinerLevels)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        const Bounds bounds{random.point(10) - 20.0f, random.point(100) + 120.0f};
        const scene::Camera camera{.eye = random.point(200), .target = random.point(50), .fov_y = random(0.02f, 2.5f)};
        const scene::View view = scene::make_view(camera, {640, 360}, bounds);
        Params params;
        params.virtual_size = i % 6, params.page = i % 3;
        const Grid grid = fit_grid(view, bounds, sun(random.point(1)), params, 64);
        ASSERT_LE(grid.levels, VIRTUAL_LEVELS);
        uint32_t entries = 0;
        for (int l = 0; l < grid.levels; ++l) {
            const Level& level = grid.level[l];
            EXPECT_EQ(level.first, entries);
            entries += uint32_t(level.side * level.side);
            EXPECT_GE(level.window_x, 0);
            EXPECT_LE(level.window_x + level.side, 1 << l);
            EXPECT_GE(level.window_y, 0);
            EXPECT_LE(level.window_y + level.side, 1 << l);
            if (l == 0) continue;
            const Level& coarser = grid.level[l - 1];
            EXPECT_LE(coarser.window_x, level.window_x / 2);
            EXPECT_GE(coarser.window_x + coarser.side - 1, (level.window_x + level.side - 1) / 2);
            EXPECT_LE(coarser.window_y, level.window_y / 2);
            EXPECT_GE(coarser.window_y + coarser.side - 1, (level.window_y + level.side - 1) / 2);
        }
        EXPECT_EQ(grid.entries, entries);
    }
}

TEST(VirtualGrid, PagesStayWhenTheViewMoves)
{
    Random random;
    const Bounds bounds{{-30, 0, -20}, {50, 12, 40}};
    const scene::Light light = sun({0.3f, -1, 0.2f});
    const auto grid_of = [&](const Bounds& b) {
        const scene::Camera camera{.eye = random.point(30), .target = random.point(30)};
        return fit_grid(scene::make_view(camera, {640, 360}, b), b, light, {}, 64);
    };
    const Grid first = grid_of(bounds);
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(same_pages(first, grid_of(bounds)));
    // nor when an object at the rim moves a little; a scene of another size is another map
    EXPECT_TRUE(same_pages(first, grid_of({{-30, 0, -20}, {50, 12.01f, 40}})));
    EXPECT_FALSE(same_pages(first, grid_of({{-300, 0, -20}, {50, 12, 40}})));
}

TEST(VirtualGrid, CoarsestPageHoldsTheScene)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        const vec3 centre = random.point(1000);
        const Bounds bounds{centre - glm::abs(random.point(30)) - 0.1f, centre + glm::abs(random.point(30)) + 0.1f};
        const scene::View view = scene::make_view({.eye = centre + vec3(0, 5, 50), .target = centre}, {640, 360}, bounds);
        const Grid grid = fit_grid(view, bounds, sun(random.point(1)), {}, 64);
        for (int c = 0; c < 8; ++c) {
            const vec3 p(c & 1 ? bounds.max.x : bounds.min.x, c & 2 ? bounds.max.y : bounds.min.y, c & 4 ? bounds.max.z : bounds.min.z);
            const vec4 h = grid.face[0].map_from_world * vec4(p, 1) + vec4(grid.offset, 0, 0);
            for (const float v : {h.x, h.y, h.z}) {
                EXPECT_GE(v, -1e-4f);
                EXPECT_LE(v, 1.0f + 1e-4f);
            }
        }
    }
}

} // namespace
} // namespace gnomon::techniques::virtual_shadow_map
