// SPDX-License-Identifier: Apache-2.0
// The page cache: what is kept, drawn again and left out, and that no picture tells.
#include "technique_fixture.h"
#include "virtual_shadow_map_session.h"

#include "scene/light.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>

extern const gnomon::shadow::TechniqueInfo technique_virtual_shadow_map;

namespace gnomon {
namespace {

using gpu::Values;
using gpu::VirtualFrame;
using gpu::VirtualSession;
namespace vsm = techniques::virtual_shadow_map;

constexpr gpu::Size small{192, 108};
const char* const lights[]
    = {"sun,elevation=40,azimuth=120,angle=0", "spot,position=3/5/4,target=0/0/0,cone=80,radius=0", "point,position=1/3/2,radius=0"};

class VirtualShadowMaps : public gpu::DeviceTest {
protected:
    static VirtualSession session(const Values& values = {}) { return {device(), technique_virtual_shadow_map, values}; }
    static scene::Light light_of(const char* text, const Bounds& bounds) { return scene::parse_light(text, {}, bounds); }
};

/// Pages that the frame's samples use.
uint32_t needed(const VirtualFrame& f) { return f.counts.requested[f.counts.coarser]; }

/// A walk along the view, turning.
scene::Camera walk(scene::Camera c, float step)
{
    const vec3 forward = glm::normalize(c.target - c.eye), side = glm::normalize(glm::cross(forward, c.up));
    const float distance = glm::length(c.target - c.eye);
    c.eye += forward * (0.02f * distance * step) + side * (0.01f * distance * step);
    c.target += side * (0.02f * distance * step);
    return c;
}

TEST_F(VirtualShadowMaps, CachedPicturesAreThoseOfPagesDrawnAnew)
{
    for (const char* name : {"contact", "terrain"}) {
        const scene::Scene s = scene::load(name);
        shadow::SceneGpu scene(device(), s);
        for (const char* text : lights) {
            const scene::Light light = light_of(text, s.bounds());
            // a small pool makes some pages leave while the walk goes on
            for (const double pool : {1024.0, 64.0}) {
                VirtualSession cached = session({{"pool_pages", pool}}), anew = session({{"pool_pages", pool}, {"cache", 0}});
                uint32_t drawn_cached = 0, drawn_anew = 0;
                for (int i = 0; i < 5; ++i) {
                    const scene::Camera camera = walk(s.cameras.front(), float(i));
                    const VirtualFrame a = cached.draw(scene, camera, light, small), b = anew.draw(scene, camera, light, small);
                    EXPECT_EQ(a.image, b.image) << name << ", " << text << ", pool " << pool << ", frame " << i;
                    EXPECT_EQ(needed(a), needed(b));
                    EXPECT_EQ(a.counts.kept + a.counts.fresh, needed(a));
                    EXPECT_EQ(b.counts.fresh, needed(b));
                    EXPECT_LE(needed(a), uint32_t(pool));
                    drawn_cached += a.counts.fresh, drawn_anew += b.counts.fresh;
                }
                EXPECT_LT(drawn_cached, drawn_anew * 7 / 10) << name << ", " << text;
            }
        }
    }
}

TEST_F(VirtualShadowMaps, TexelsAreNoLongerThanPixels)
{
    for (const char* name : {"contact", "citadel", "terrain", "duelling_frusta"}) {
        const scene::Scene s = scene::load(name);
        shadow::SceneGpu scene(device(), s);
        const scene::Light light = light_of(lights[0], s.bounds());
        VirtualSession technique = session({{"show", 2}});
        const VirtualFrame f = technique.draw(scene, s.cameras.front(), light, {320, 180});
        size_t samples = 0, long_texels = 0;
        for (size_t i = 0; i < f.image.size(); ++i) {
            if (f.depth[i] == 0.0f || f.image[i] == 0.0f) continue; // nothing, or turned away
            ++samples, long_texels += f.image[i] > 0.5001f;
        }
        std::printf("%s: %zu of %zu samples have longer texels; requested %u, needed %u, lowered %u, levels %d, pairs %u\n", name,
            long_texels, samples, f.counts.requested[0], needed(f), f.counts.coarser, technique.technique().grid().levels, f.counts.pairs);
        ASSERT_GT(samples, 1000u) << name;
        EXPECT_LE(double(long_texels), 0.01 * double(samples)) << name;
    }
}

TEST_F(VirtualShadowMaps, FullPoolMakesShadowsCoarserAndLeavesNoHoles)
{
    // a floor under the open sky: whatever page a pixel finds, it is lit
    const scene::Scene floor = gpu::floor_scene(20);
    shadow::SceneGpu open(device(), floor);
    const scene::Camera low{.eye = {0, 1, 15}, .target = {0, 0, 0}};
    for (const char* text : lights) {
        VirtualSession technique = session({{"pool_pages", 16}, {"footprint", 0.2}});
        const VirtualFrame f = technique.draw(open, low, light_of(text, floor.bounds()), {320, 180});
        EXPECT_GT(f.counts.requested[0], 16u) << text;
        EXPECT_LE(needed(f), 16u) << text;
        size_t partly = 0;
        for (const float v : f.image) partly += v > 0.0f && v < 1.0f;
        EXPECT_EQ(partly, 0u) << text;
    }

    const scene::Scene s = scene::load("citadel");
    shadow::SceneGpu scene(device(), s);
    const scene::Light light = light_of(lights[0], s.bounds());
    VirtualSession large = session();
    const VirtualFrame fine = large.draw(scene, s.cameras.front(), light, small);
    double before = 0.0;
    for (const double pool : {256.0, 64.0, 16.0}) {
        VirtualSession little = session({{"pool_pages", pool}});
        const VirtualFrame coarse = little.draw(scene, s.cameras.front(), light, small);
        double error = 0.0;
        for (size_t i = 0; i < fine.image.size(); ++i) error += std::abs(double(fine.image[i]) - double(coarse.image[i]));
        error /= double(fine.image.size());
        EXPECT_GE(error, before) << pool;
        EXPECT_LT(error, 0.2) << pool;
        before = error;
    }
}

/// Whether a page, border and all, may see something of a box: none of its four sides has the whole box before it.
bool page_reaches(const vsm::Grid& grid, glm::uvec2 page, const Bounds& box)
{
    const int face = int(page.x >> 24), level = int(page.y >> 24);
    const double drawn = grid.page + 2 * grid.border, scale = 2.0 * (grid.page << level) / drawn;
    const glm::dvec2 first
        = (glm::dvec2(page.x & 0xffffff, page.y & 0xffffff) - glm::dvec2(grid.offset) * double(1 << level)) * double(grid.page);
    const glm::dvec2 shift = -2.0 * (first - double(grid.border)) / drawn - 1.0;
    const glm::dmat4 m(grid.face[face].map_from_world);
    bool before[4] = {true, true, true, true};
    for (int c = 0; c < 8; ++c) {
        const glm::dvec3 p(c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y, c & 4 ? box.max.z : box.min.z);
        const glm::dvec4 h = m * glm::dvec4(p, 1);
        const double x = scale * h.x + shift.x * h.w, y = scale * h.y + shift.y * h.w;
        before[0] &= x<-h.w, before[1] &= x> h.w, before[2] &= y<-h.w, before[3] &= y> h.w;
    }
    return !before[0] && !before[1] && !before[2] && !before[3];
}

TEST_F(VirtualShadowMaps, MovedObjectRedrawsThePagesThatItTouches)
{
    scene::Scene before = gpu::floor_scene(8);
    for (int i = 0; i < 9; ++i) gpu::add_quad(before, {float(i % 3 - 1) * 4, 1, float(i / 3 - 1) * 4}, 0.5f);
    scene::Scene after = before;
    after.instances[5].world_from_object = glm::translate(mat4(1), vec3(0.3f, 0.2f, 0.1f)) * after.instances[5].world_from_object;
    const scene::Camera camera{.eye = {0, 7, 12}, .target = {0, 0, 0}};
    for (const char* text : lights) {
        const scene::Light light = light_of(text, before.bounds());
        VirtualSession cached = session({{"footprint", 0.2}}), fresh = session({{"footprint", 0.2}});
        std::optional<shadow::SceneGpu> scene(std::in_place, device(), before);
        const VirtualFrame first = cached.draw(*scene, camera, light, small);
        EXPECT_EQ(cached.draw(*scene, camera, light, small).counts.fresh, 0u) << text;
        std::set<std::pair<uint32_t, uint32_t>> there;
        for (const vsm::Slot& slot : cached.technique().slots()) there.emplace(slot.page.x, slot.page.y);
        scene.emplace(device(), after); // likely at the old one's address
        const VirtualFrame moved = cached.draw(*scene, camera, light, small), want = fresh.draw(*scene, camera, light, small);
        EXPECT_EQ(moved.image, want.image) << text;
        EXPECT_GT(moved.counts.fresh, 0u) << text;
        EXPECT_LT(moved.counts.fresh, needed(moved) / 3) << text;
        EXPECT_NE(moved.image, first.image) << text;

        // Drawn anew: pages that the object was in or is in, and those that now are looked at for the first time. Sides that a box only
        // just touches are a matter of rounding.
        const auto touched = [&](float slack) {
            const auto reaches = [&](glm::uvec2 page, const scene::Scene& of) {
                Bounds b = transformed(of.meshes[5].bounds, of.instances[5].world_from_object);
                b.min -= slack, b.max += slack;
                return page_reaches(cached.technique().grid(), page, b);
            };
            uint32_t count = 0;
            for (const vsm::Slot& slot : cached.technique().slots())
                count += slot.used == cached.technique().frame()
                    && (!there.count({slot.page.x, slot.page.y}) || reaches(slot.page, before) || reaches(slot.page, after));
            return count;
        };
        EXPECT_GE(moved.counts.fresh, touched(0.0f)) << text;
        EXPECT_LE(moved.counts.fresh, touched(1e-3f)) << text;
        EXPECT_EQ(cached.draw(*scene, camera, light, small).counts.fresh, 0u) << text;
    }
}

TEST_F(VirtualShadowMaps, DeformedMeshRedrawsItsPages)
{
    scene::Scene before = gpu::half_shadowed(), after = before;
    after.meshes[1].positions[2].y += 0.4f;
    after.meshes[1].bounds.add(after.meshes[1].positions[2]);
    const scene::Camera camera{.eye = {0, 5, 8}, .target = {0, 0, 0}};
    shadow::SceneGpu scene_before(device(), before), scene_after(device(), after);
    const scene::Light light = light_of(lights[0], before.bounds());
    VirtualSession cached = session({{"footprint", 0.2}}), fresh = session({{"footprint", 0.2}});
    const VirtualFrame first = cached.draw(scene_before, camera, light, small);
    const VirtualFrame got = cached.draw(scene_after, camera, light, small), want = fresh.draw(scene_after, camera, light, small);
    EXPECT_EQ(got.image, want.image);
    EXPECT_NE(got.image, first.image);
    EXPECT_GT(got.counts.kept, 0u);
}

TEST_F(VirtualShadowMaps, AnotherSceneOrLightForgetsAllPages)
{
    const scene::Scene a = gpu::half_shadowed();
    scene::Scene b = a;
    gpu::add_quad(b, {2, 1, 0}, 1);
    shadow::SceneGpu scene_a(device(), a), scene_b(device(), b);
    const scene::Camera camera{.eye = {0, 5, 8}, .target = {0, 0, 0}};
    VirtualSession technique = session();
    for (const auto& [scene, text] :
        {std::pair{&scene_a, lights[0]}, {&scene_b, lights[0]}, {&scene_b, lights[2]}, {&scene_a, lights[1]}}) {
        const scene::Light light = light_of(text, scene->bounds());
        VirtualSession other = session();
        EXPECT_EQ(technique.draw(*scene, camera, light, small).image, other.draw(*scene, camera, light, small).image) << text;
    }
}

TEST_F(VirtualShadowMaps, BadInputGivesSaneImages)
{
    struct Case {
        const char* what;
        scene::Scene scene;
        scene::Camera camera;
        const char* light;
    };
    scene::Scene huge;
    huge.materials.emplace_back();
    huge.materials[0].double_sided = true;
    scene::Mesh triangle;
    triangle.positions = {{-4e5f, 0, -4e5f}, {0, 0, 4e5f}, {4e5f, 0, -4e5f}};
    triangle.indices = {0, 1, 2};
    scene::complete(triangle);
    huge.meshes.push_back(triangle);
    huge.instances.push_back({0, mat4(1)});
    const scene::Camera usual{.eye = {0, 3, 6}, .target = {0, 0, 0}};
    const Case cases[] = {{"light inside the frustum", gpu::half_shadowed(), usual, "point,position=0/1.5/2,radius=0"},
        {"light at the eye", gpu::half_shadowed(), usual, "point,position=0/3/6,radius=0"},
        {"sun along the view", gpu::half_shadowed(), {.eye = {0, 6, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}}, "sun,elevation=90,angle=0"},
        {"no receiver in view", gpu::half_shadowed(), {.eye = {0, 3, 6}, .target = {0, 9, 12}}, lights[0]},
        {"a light that touches the floor", gpu::half_shadowed(), usual, "point,position=1/0/1,radius=0"},
        {"extents of eight thousand kilometres", gpu::floor_scene(4e6f), usual, lights[0]}, {"one huge triangle", huge, usual, lights[0]},
        {"one huge triangle", huge, usual, lights[2]},
        {"an orthographic view", gpu::half_shadowed(), gpu::camera_above({0, 0, 0}, 5, 3), lights[0]},
        {"a sun on the horizon", gpu::half_shadowed(), usual, "sun,elevation=0,azimuth=90,angle=0"}};
    for (const Case& c : cases) {
        shadow::SceneGpu scene(device(), c.scene);
        const scene::Light light = light_of(c.light, c.scene.bounds());
        VirtualSession technique = session();
        const VirtualFrame first = technique.draw(scene, c.camera, light, small), second = technique.draw(scene, c.camera, light, small);
        size_t broken = 0;
        for (const float v : first.image) broken += !(v >= 0.0f && v <= 1.0f);
        EXPECT_EQ(broken, 0u) << c.what;
        EXPECT_EQ(first.image, second.image) << c.what;
        EXPECT_EQ(second.counts.fresh, 0u) << c.what;
        if (std::string_view(c.what) == "no receiver in view") {
            EXPECT_EQ(needed(first), 0u);
        }
    }
}

/// Prints how much of a first frame's time later ones take: no test of times, which depend on what else the machine does.
TEST_F(VirtualShadowMaps, CostOfLaterFrames)
{
    const scene::Scene s = scene::load("citadel");
    shadow::SceneGpu scene(device(), s);
    const scene::Light light = light_of(lights[0], s.bounds());
    VirtualSession anew = session({{"cache", 0}}), cached = session();
    double first = 0.0, later = 0.0;
    uint32_t pages_first = 0, pages_later = 0;
    for (int i = 0; i < 8; ++i) {
        const scene::Camera camera = walk(s.cameras.front(), 0.25f * float(i));
        const VirtualFrame a = anew.draw(scene, camera, light, {480, 270}), b = cached.draw(scene, camera, light, {480, 270});
        if (i < 2) continue; // pipelines are made on first use
        first += a.ms, later += b.ms, pages_first += a.counts.fresh, pages_later += b.counts.fresh;
    }
    std::printf("walking through citadel: %.2f of the time and %u of %u pages of frames without a cache\n", later / first, pages_later,
        pages_first);
    EXPECT_LT(pages_later, pages_first / 4);
}

} // namespace
} // namespace gnomon
