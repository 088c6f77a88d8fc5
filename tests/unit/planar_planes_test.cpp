// SPDX-License-Identifier: Apache-2.0
// Which planes of a scene receive planar shadows.
#include "scene/load.h"
#include "techniques/planar/planes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace {

using techniques::planar::find_planes;
using techniques::planar::Plane;
using techniques::planar::plane_thickness;

/// A grid of quads over the unit square of `axes`' first two columns, lifted along the third by `bump`.
void add_sheet(scene::Scene& s, const mat4& axes, int cells, float bump = 0.0f)
{
    scene::Mesh mesh;
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x)
            mesh.positions.push_back({float(x) / float(cells), float(y) / float(cells), bump * float((x * 7 + y * 13) % 5)});
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            const uint32_t a = uint32_t(y * (cells + 1) + x), b = a + uint32_t(cells) + 1;
            for (const uint32_t i : {a, a + 1, b, b, a + 1, b + 1}) mesh.indices.push_back(i);
        }
    scene::complete(mesh);
    s.instances.push_back({int(s.meshes.size()), axes});
    s.meshes.push_back(mesh);
}

scene::Scene empty_scene()
{
    scene::Scene s;
    s.materials.emplace_back();
    return s;
}

mat4 placed(vec3 at, vec3 axis, float degrees, float size)
{
    return glm::translate(mat4(1), at) * glm::rotate(mat4(1), glm::radians(degrees), glm::normalize(axis))
        * glm::scale(mat4(1), vec3(size));
}

TEST(PlanarPlanes, CoplanarPiecesAddUpWhateverTheirPlaceAndFacing)
{
    scene::Scene s = empty_scene();
    const vec3 axis(1, 2, 0.5f);
    // four pieces of 4 m2 in one oblique plane, one of them turned over; and one of 9 m2 elsewhere
    for (int i = 0; i < 4; ++i) {
        mat4 m = placed(vec3(0), axis, 37, 1) * glm::translate(mat4(1), vec3(3.0f * float(i) - 5, 2.0f * float(i & 1), 0.7f));
        if (i == 2) m = m * glm::rotate(mat4(1), pi, vec3(1, 0, 0));
        add_sheet(s, m * glm::scale(mat4(1), vec3(2)), 9);
    }
    add_sheet(s, placed({0, 5, 0}, {0, 0, 1}, 0, 3), 4);
    const std::vector<Plane> planes = find_planes(s, 8, 0.01);
    ASSERT_EQ(planes.size(), 2u);
    EXPECT_NEAR(planes[0].area, 16, 1e-3);
    EXPECT_NEAR(planes[1].area, 9, 1e-3);
    const glm::dvec3 n = glm::dmat3(placed(vec3(0), axis, 37, 1)) * glm::dvec3(0, 0, 1);
    EXPECT_NEAR(std::abs(glm::dot(glm::dvec3(planes[0].equation), n)), 1, 1e-6);
    EXPECT_NEAR(std::abs(planes[0].equation.w), 0.7, 1e-5);
    EXPECT_NEAR(std::abs(planes[1].equation.z), 1, 1e-9);
    EXPECT_NEAR(planes[1].equation.w, 0, 1e-9);
}

TEST(PlanarPlanes, ParallelSurfacesFurtherApartThanTheThicknessAreTwo)
{
    scene::Scene s = empty_scene();
    add_sheet(s, placed(vec3(0), {1, 0, 0}, -90, 4), 3);
    add_sheet(s, placed({0, 1, 0}, {1, 0, 0}, -90, 4), 3);
    const float apart = 3.0f * float(plane_thickness(s));
    add_sheet(s, placed({0, apart, 0}, {1, 0, 0}, -90, 3), 3);
    const std::vector<Plane> planes = find_planes(s, 8, 0.01);
    ASSERT_EQ(planes.size(), 3u);
    EXPECT_NEAR(planes[0].area, 16, 1e-3);
    EXPECT_NEAR(planes[2].area, 9, 1e-3);
}

TEST(PlanarPlanes, SmallOnesAndBlendedOnesDoNotCount)
{
    scene::Scene s = empty_scene();
    add_sheet(s, placed(vec3(0), {1, 0, 0}, -90, 10), 2);
    add_sheet(s, placed({0, 1, 0}, {1, 0, 0}, -90, 0.9f), 2); // 0.8 % of the area
    EXPECT_EQ(find_planes(s, 8, 0.01).size(), 1u);
    EXPECT_EQ(find_planes(s, 8, 0.005).size(), 2u);
    EXPECT_EQ(find_planes(s, 1, 0.005).size(), 1u);
    s.materials[0].alpha = scene::AlphaMode::blend;
    EXPECT_TRUE(find_planes(s, 8, 0.01).empty());
}

TEST(PlanarPlanes, ACurvedSceneHasNone)
{
    scene::Scene s = empty_scene();
    add_sheet(s, placed(vec3(0), {1, 0, 0}, -90, 10), 40, 0.01f);
    EXPECT_TRUE(find_planes(s, 8, 0.05).empty());
    EXPECT_TRUE(find_planes(empty_scene(), 8, 0.01).empty());
}

TEST(PlanarPlanes, FarFromTheOriginAFloorIsStillOnePlane)
{
    scene::Scene s = empty_scene();
    add_sheet(s, placed({5000, 20, -3000}, {1, 0.1f, 0}, -75, 10), 20);
    const std::vector<Plane> planes = find_planes(s, 8, 0.01);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(planes[0].area, 100, 1);
}

} // namespace
} // namespace gnomon
