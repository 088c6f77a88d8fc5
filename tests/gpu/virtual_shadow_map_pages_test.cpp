// SPDX-License-Identifier: Apache-2.0
// Which pages are asked for, against the same in double precision, and what is in them, against one large map.
#include "virtual_shadow_map_session.h"

#include "scene/light.h"
#include "shadow/light_constants.h"
#include "shadow/parts/fit.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <tuple>

extern const gnomon::shadow::TechniqueInfo technique_virtual_shadow_map;

namespace gnomon {
namespace {

using gpu::VirtualFrame;
using gpu::VirtualSession;
namespace vsm = techniques::virtual_shadow_map;
using Page = std::tuple<int, int, int, int>; ///< face, level, column, row
using dvec3 = glm::dvec3;

Page page_of(const vsm::Slot& s) { return {int(s.page.x >> 24), int(s.page.y >> 24), int(s.page.x & 0xffffff), int(s.page.y & 0xffffff)}; }

dvec3 decode_normal(uint32_t code)
{
    const double x = std::max(int16_t(code & 0xffff) / 32767.0, -1.0), y = std::max(int16_t(code >> 16) / 32767.0, -1.0);
    dvec3 n(x, y, 1 - std::abs(x) - std::abs(y));
    if (n.z < 0) n.x = (1 - std::abs(y)) * (x >= 0 ? 1 : -1), n.y = (1 - std::abs(x)) * (y >= 0 ? 1 : -1);
    return glm::normalize(n);
}

/// Requests as the technique's first pass makes them.
struct Twin {
    const shaders::View view;
    const shaders::Light light;
    const vsm::Grid& grid;
    const double footprint, least_sine;
    std::set<Page> certain, possible; ///< pages that a sample surely needs; those that it may need, by how numbers round

    dvec3 unproject(double x, double y, double depth) const
    {
        const glm::dvec4 p
            = glm::dmat4(view.world_from_clip) * glm::dvec4(x / double(view.size.x) * 2 - 1, y / double(view.size.y) * 2 - 1, depth, 1);
        return dvec3(p) / p.w;
    }

    /// A neighbouring pixel's ray on the plane through p, to first order (perspective views).
    dvec3 step_on_plane(dvec3 p, dvec3 n, dvec3 near_a, dvec3 near_b) const
    {
        const dvec3 eye(view.eye), forward(view.forward), ray = glm::normalize(p - eye);
        const dvec3 across = (near_b - near_a) * (glm::dot(p - eye, forward) / glm::dot(near_a - eye, forward));
        double facing = glm::dot(n, ray);
        if (std::abs(facing) < 1e-6) facing = 1e-6;
        return across - ray * (glm::dot(n, across) / facing);
    }

    int face_of(dvec3 p) const
    {
        if (grid.layout_kind != LIGHT_MAP_CUBE) return 0;
        const dvec3 d = p - dvec3(grid.centre), a = glm::abs(d);
        if (a.x >= a.y && a.x >= a.z) return d.x >= 0 ? 0 : 1;
        if (a.y >= a.z) return d.y >= 0 ? 2 : 3;
        return d.z >= 0 ? 4 : 5;
    }

    Page choose(int face, double wanted, glm::dvec2 uv) const
    {
        for (int l = std::clamp(int(std::ceil(wanted)), 0, grid.levels - 1);; --l) {
            const int pages = 1 << l;
            const glm::dvec2 at = glm::floor((uv + glm::dvec2(grid.offset)) * double(pages));
            const int x = std::clamp(int(at.x), 0, pages - 1), y = std::clamp(int(at.y), 0, pages - 1);
            const vsm::Level& level = grid.level[l];
            const bool inside
                = x >= level.window_x && y >= level.window_y && x < level.window_x + level.side && y < level.window_y + level.side;
            if (l == 0 || inside) return {face, l, x, y};
        }
    }

    void add(double x, double y, double depth, uint32_t code)
    {
        const dvec3 p = unproject(x, y, depth), n = decode_normal(code);
        const dvec3 d = light.kind == LIGHT_DIRECTIONAL ? -dvec3(light.direction) : glm::normalize(dvec3(light.position) - p);
        const double sine = glm::dot(n, d);
        const double cone = light.kind == LIGHT_SPOT ? glm::dot(-d, dvec3(light.direction)) - double(light.cos_outer) : 1.0;
        if (sine < -1e-4 || cone < -1e-5) return;
        const int face = face_of(p);
        const glm::dmat4 m(grid.face[face].map_from_world);
        const glm::dvec4 h = m * glm::dvec4(p, 1);
        const auto uv_step = [&](dvec3 step) {
            const glm::dvec4 hd = m * glm::dvec4(step, 0);
            return (glm::dvec2(hd) * h.w - glm::dvec2(h) * hd.w) / (h.w * h.w);
        };
        const dvec3 at = unproject(x, y, 1);
        const glm::dvec2 across = uv_step(step_on_plane(p, n, at, unproject(x + 1, y, 1)));
        const glm::dvec2 down = uv_step(step_on_plane(p, n, at, unproject(x, y + 1, 1)));
        const glm::dmat2 sides = glm::inverse(glm::dmat2(across, down));
        const double longer = std::max(glm::length(sides[0]), glm::length(sides[1])) * std::min(1.0, sine / least_sine);
        const double wanted = std::max(0.0, std::log2(longer / (grid.page * footprint)));
        const glm::dvec2 uv = glm::dvec2(h) / h.w;
        std::set<Page> pages;
        for (const double dw : {-0.01, 0.01})
            for (const double du : {-1e-6, 1e-6})
                for (const double dv : {-1e-6, 1e-6}) pages.insert(choose(face, wanted + dw, uv + glm::dvec2(du, dv)));
        possible.insert(pages.begin(), pages.end());
        if (pages.size() == 1 && sine > 1e-4 && cone > 1e-5) certain.insert(pages.begin(), pages.end());
    }
};

class VirtualPages : public gpu::DeviceTest { };

TEST_F(VirtualPages, AreThoseThatTheSamplesNeed)
{
    constexpr gpu::Size size{160, 90};
    for (const char* name : {"contact", "citadel"})
        for (const char* text : {"sun,elevation=40,azimuth=120,angle=0", "spot,position=3/5/4,target=0/0/0,cone=80,radius=0",
                 "point,position=1/3/2,radius=0"}) {
            const scene::Scene s = scene::load(name);
            shadow::SceneGpu scene(device(), s);
            const scene::Light light = scene::parse_light(text, {}, s.bounds());
            VirtualSession session(device(), technique_virtual_shadow_map, {});
            const VirtualFrame f = session.draw(scene, s.cameras.front(), light, size);
            ASSERT_EQ(f.counts.coarser, 0u);
            Twin twin{shadow::view_constants(scene::make_view(s.cameras.front(), size, s.bounds()), 0),
                shadow::light_constants(light, s.bounds()), session.technique().grid(), 1.0, std::sin(2.0 * 3.14159265358979 / 180.0)};
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const size_t i = size_t(y * size.width + x);
                    if (f.depth[i] != 0.0f) twin.add(x + 0.5, y + 0.5, double(f.depth[i]), session.normals()[2 * i + 1]);
                }
            std::set<Page> got;
            for (const vsm::Slot& slot : session.technique().slots())
                if (slot.used == session.technique().frame()) got.insert(page_of(slot));
            EXPECT_EQ(got.size(), f.counts.requested[0]) << name << ", " << text;
            EXPECT_TRUE(std::includes(got.begin(), got.end(), twin.certain.begin(), twin.certain.end())) << name << ", " << text;
            EXPECT_TRUE(std::includes(twin.possible.begin(), twin.possible.end(), got.begin(), got.end())) << name << ", " << text;
            EXPECT_GT(twin.certain.size() * 10, got.size() * 9) << name << ", " << text;
        }
}

/// With the finest level everywhere, pages are pieces of one large map.
TEST_F(VirtualPages, OfTheFinestLevelAreOneLargeMap)
{
    constexpr int map_size = 2048;
    const scene::Scene s = scene::load("contact");
    shadow::SceneGpu scene(device(), s);
    for (const char* text : {"spot,position=3/5/4,target=0/0/0,cone=80,radius=0", "sun,elevation=40,azimuth=120,angle=0"}) {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        VirtualSession session(
            device(), technique_virtual_shadow_map, {{"virtual_size", 1}, {"finer_levels", 0}, {"footprint", 0.01}, {"grazing", 0}});
        const VirtualFrame f = session.draw(scene, s.cameras.front(), light, {192, 108});
        ASSERT_EQ(f.counts.coarser, 0u);
        const vsm::Grid& grid = session.technique().grid();
        shaders::LightMap map{};
        map.layer_count = 1, map.size = map_size;
        map.layers[0] = grid.face[0];
        mat4& m = map.layers[0].map_from_world;
        m[3].x += grid.offset.x * m[3].w, m[3].y += grid.offset.y * m[3].w; // zero where the layer is perspective
        gpu::Image large = image("large map", VK_FORMAT_D32_SFLOAT, {map_size, map_size});
        gpu::PassList passes(device());
        const scene::View view = scene::make_view(s.cameras.front(), {192, 108}, s.bounds());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        shadow::parts::draw_light_layers(passes, {s, view, light, scene, g, g.depth, 0}, map, {.size = map_size}, passes.import(large));
        device().submit(std::move(passes));
        const std::vector<float> want = device().read_back(large).values;

        size_t texels = 0, differ = 0, far = 0;
        const std::vector<vsm::Slot> slots = session.technique().slots();
        for (uint32_t i = 0; i < slots.size(); ++i) {
            if (slots[i].used != session.technique().frame()) continue;
            const auto [face, level, column, row] = page_of(slots[i]);
            ASSERT_EQ(level, grid.levels - 1);
            const base::Picture got = device().read_back(session.technique().pool(), i);
            for (int y = 0; y < got.size.height; ++y)
                for (int x = 0; x < got.size.width; ++x) {
                    const int u = column * grid.page + x - grid.border, v = row * grid.page + y - grid.border;
                    if (u < 0 || v < 0 || u >= map_size || v >= map_size) continue;
                    const float a = got.values[size_t(y * got.size.width + x)], b = want[size_t(v * map_size + u)];
                    ++texels, differ += std::abs(a - b) > 1e-5f * std::max(a, b), far += std::abs(a - b) > 1e-3f * std::max(a, b);
                }
        }
        std::printf(
            "%s: of %zu texels, %zu differ by more than 1e-5 and %zu by more than 1e-3 of their depth\n", text, texels, differ, far);
        ASSERT_GT(texels, 400000u);
        // two matrices round vertices to two neighbours of 1/256 texel now and then: it shows where an edge runs through a texel's centre
        EXPECT_LT(double(far), 2e-4 * double(texels)) << text;
    }
}

} // namespace
} // namespace gnomon
