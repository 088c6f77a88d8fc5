// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/analytic.h"
#include "technique_fixture.h"

#include <algorithm>
#include <cmath>
#include <string>

extern const gnomon::shadow::TechniqueInfo technique_shadow_map;

namespace gnomon::gpu {

/// A horizontal sheet.
inline void add_sheet(scene::Scene& s, float height, vec2 lo, vec2 hi)
{
    scene::Mesh mesh;
    mesh.positions = {{lo.x, height, lo.y}, {lo.x, height, hi.y}, {hi.x, height, hi.y}, {hi.x, height, lo.y}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(mesh);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(mesh);
}

/// A panel 4 m above the origin, and a sheet that hides the part [lo, hi] of what the origin sees of it, metres about its centre.
inline constexpr const char* square_light = "rect,position=0/4/0,target=0/0/0,width=1,height=1";
inline void add_blocker(scene::Scene& s, float height, vec2 lo, vec2 hi) { add_sheet(s, height, lo * (height / 4), hi * (height / 4)); }

/// A sheet one metre above the floor over x < 0, wider than the penumbrae are.
inline scene::Scene half_plane()
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-4, 1, 0}, 4);
    return s;
}

/// What every soft technique is held to.
class SoftTest : public TechniqueTest {
protected:
    static double at_origin(const shadow::TechniqueInfo& info, const scene::Scene& s, const char* light, const Values& values)
    {
        return mean(draw(info, s, camera_above({0, 0, 0}, 0.05f, 1e-4f), {2, 2}, light, values));
    }

    /// The largest error across the penumbra of half_plane(), 0.4 m to each side of x = 0, at 128 points.
    static double half_plane_error(const shadow::TechniqueInfo& info, const char* light, const Values& values)
    {
        constexpr float half = 0.4f;
        constexpr int n = 128;
        const scene::Scene s = half_plane();
        const scene::Light parsed = scene::parse_light(light, {}, s.bounds());
        // a row of pixels, each 2 half / n wide
        const std::vector<float> got = draw(info, s, camera_above({0, 0, 0}, 0.9f, half / float(n)), {n, 1}, light, values);
        double off = 0;
        for (int i = 0; i < n; ++i) {
            const float x = -half + 2 * half * (float(i) + 0.5f) / n;
            off = std::max(off, std::abs(double(got[size_t(i)]) - scene::analytic::half_plane_visibility(parsed, {x, 0, 0}, 0, 1)));
        }
        return off;
    }

    /// A square in a disk's place gives a ramp where the truth is the area of a segment: off by at most 0.0577 around the disk, 0.0226 at
    /// its area, and by `texels` more.
    static void expect_ramps_before_disks(const shadow::TechniqueInfo& info, double texels, Values values)
    {
        const char* light = "disk,position=0/5/0,target=0/0/0,radius=0.8";
        values.emplace_back("kernel", 0.0);
        const double around = half_plane_error(info, light, values);
        values.back().second = 1.0;
        EXPECT_LT(around, 0.0577 + texels);
        EXPECT_GT(around, 0.05);
        EXPECT_LT(half_plane_error(info, light, values), 0.0226 + texels);
    }

    /// Lights without a size cast the hard shadows of a map of the scene.
    static void expect_hard_shadows(const shadow::TechniqueInfo& info, Values values)
    {
        scene::Scene s = floor_scene(4);
        add_quad(s, {-1, 1, 0}, 1);
        add_quad(s, {1, 0.3f, 0.5f}, 0.5f);
        const scene::Camera camera = camera_above({0, 0, 0}, 6, 2.5f);
        values.emplace_back("fit", 0.0);
        for (const char* light : {"sun,elevation=60,azimuth=20,angle=0", "spot,position=1/6/1,target=0/0/0,cone=80,radius=0",
                 "point,position=0.5/4/0.3,radius=0"}) {
            const auto soft = draw(info, s, camera, {128, 96}, light, values);
            const auto hard = draw(technique_shadow_map, s, camera, {128, 96}, light, {{"fit", 0}});
            size_t grey = 0, different = 0;
            for (size_t i = 0; i < soft.size(); ++i) {
                grey += soft[i] != 0.0f && soft[i] != 1.0f;
                different += std::abs(soft[i] - hard[i]) > 0.5f;
            }
            EXPECT_EQ(grey, 0u) << light;
            // the maps differ by the rim that soft methods leave, so that edges fall into other texels
            EXPECT_LT(different, soft.size() / 100) << light;
        }
    }

    /// Lights larger than the scene, in it, across it, turned away and without a side, with each of `ways`.
    static void expect_fractions(const shadow::TechniqueInfo& info, const std::vector<Values>& ways)
    {
        scene::Scene s = floor_scene(2);
        add_quad(s, {0, 0.5f, 0}, 0.5f);
        const scene::Camera camera{.eye = {0, 3, 4}, .target = {0, 0, 0}};
        for (const char* light : {"sun,elevation=1,azimuth=20,angle=60", "sun,elevation=-30,azimuth=20,angle=5",
                 "rect,position=0/1/0,target=0/0/0,width=100,height=100", "rect,position=0/0/0,target=1/0/0,width=1,height=1",
                 "rect,position=0/1/0,target=0/0/0,width=0.00001,height=2", "disk,position=0/0.5/0,target=0/0/0,radius=3",
                 "disk,position=0/-1/0,target=0/-2/0,radius=1", "point,position=0/0.5/0,radius=2", "point,position=0/0.001/1,radius=0.5",
                 "spot,position=0/30/0,target=0/0/0,cone=1,radius=5"})
            for (const double size : {16.0, 64.0})
                for (Values values : ways) {
                    values.emplace_back("map_size", size);
                    for (const float v : draw(info, s, camera, {48, 32}, light, values))
                        ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << light << ": " << v;
                }
    }
};

} // namespace gnomon::gpu
