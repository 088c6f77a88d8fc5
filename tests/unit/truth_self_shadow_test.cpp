// SPDX-License-Identifier: Apache-2.0
#include "truth/truth.h"
#include "truth_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gnomon;
using namespace truth_test;

namespace {

/// A plane of 2 n^2 triangles about `centre`, turned by `m`.
scene::Scene tilted_plane(int n, const mat4& m)
{
    scene::Mesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            mesh.positions.emplace_back(2.0f * float(i) / float(n) - 1.0f, 0.0f, 1.0f - 2.0f * float(j) / float(n));
    for (uint32_t j = 0; j < uint32_t(n); ++j)
        for (uint32_t i = 0; i < uint32_t(n); ++i) {
            const uint32_t a = j * uint32_t(n + 1) + i, b = a + uint32_t(n) + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    scene::complete(mesh);
    scene::Scene s = scene_of({mesh});
    s.instances[0].world_from_object = m;
    return s;
}

/// Pixels of an object that turn to the light, and how many of them are dark.
struct Count {
    size_t facing = 0, dark = 0;
};
Count shadowed(const scene::Scene& s, const scene::View& view, vec3 to_light, float least_cosine, size_t flatten_limit)
{
    const truth::Tracer tracer(s, flatten_limit);
    const truth::Primary p = tracer.primary(view);
    const truth::Visibility v = tracer.visibility(view, p, light_of(scene::DirectionalLight{-to_light, 0.0f}), {});
    Count count;
    for (size_t i = 0; i < p.primitive.size(); ++i) {
        const float* n = p.normal.values.data() + 3 * i;
        if (p.primitive[i] == truth::no_primitive || glm::dot(vec3(n[0], n[1], n[2]), to_light) < least_cosine) continue;
        ++count.facing;
        count.dark += v.mean.values[i] < 1.0f;
    }
    return count;
}

} // namespace

TEST(TruthSelfShadow, tilted_planes_of_many_triangles_are_lit_at_every_angle)
{
    size_t facing = 0;
    for (const int n : {1, 16})
        for (int tilt = 0; tilt < 360; tilt += 15)
            for (const float distance : {0.0f, 30.0f}) {
                const vec3 centre = distance * glm::normalize(vec3(1, 0.3f, -0.6f));
                mat4 m = glm::translate(mat4(1), centre);
                m = glm::rotate(m, glm::radians(float(tilt) + 0.37f), glm::normalize(vec3(0.3f, 0.1f, 1)));
                const scene::Scene s = tilted_plane(n, m);
                const vec3 normal(m * vec4(0, 1, 0, 0)), along(m * vec4(1, 0, 0, 0));
                const scene::View view = look(s, centre + 2.5f * normal + 0.5f * along, centre, {48, 48});
                for (const float elevation : {90.0f, 30.0f, 3.0f, 0.5f}) { // above the plane, in degrees
                    const float e = glm::radians(elevation);
                    const Count c = shadowed(s, view, glm::normalize(std::sin(e) * normal + std::cos(e) * along), 0.0f, 8'000'000);
                    EXPECT_EQ(c.dark, 0u) << "n " << n << " tilt " << tilt << " distance " << distance << " elevation " << elevation;
                    facing += c.facing;
                }
            }
    EXPECT_GT(facing, 200000u) << "the pictures are mostly background";
}

TEST(TruthSelfShadow, spheres_are_lit_wherever_they_are)
{
    for (const float distance : {1e-3f, 1.0f, 1e2f, 1e4f, 1e5f})
        for (const size_t flatten_limit : {size_t(8'000'000), size_t(0)}) {
            const vec3 centre = distance * glm::normalize(vec3(1, 0.7f, -0.4f));
            // Far out the corners lie on a grid of an ulp of the distance; a triangle must stay far larger than that, or the sphere
            // truly has dents.
            const float radius = std::max(1.0f, distance * 2e-3f);
            scene::Scene s = scene_of({sphere(vec3(0), 1.0f, 32, 48)});
            s.instances[0].world_from_object = glm::scale(glm::translate(mat4(1), centre), vec3(radius));
            s.instances.push_back(s.instances[0]); // twice the mesh, so that it is instanced; far away
            s.instances[1].world_from_object = glm::translate(s.instances[0].world_from_object, vec3(-50, 3, 2));
            const scene::View view = look(s, centre + radius * vec3(1.5f, 1.5f, 2), centre, {96, 96});
            for (const vec3 to_light : {vec3(0, 1, 0), glm::normalize(vec3(1, 0.2f, 1)), glm::normalize(vec3(-1, 0.3f, 0.2f))}) {
                const Count c = shadowed(s, view, to_light, 0.02f, flatten_limit);
                EXPECT_EQ(c.dark, 0u) << "distance " << distance << " limit " << flatten_limit;
                EXPECT_GT(c.facing, 500u);
            }
        }
}

TEST(TruthSelfShadow, a_lamp_modelled_in_its_lights_place_does_not_block_it)
{
    for (const vec3 origin : {vec3(0), vec3(310, 20, -170)}) {
        std::vector<vec3> points, normals;
        for (int i = 0; i < 400; ++i) {
            points.push_back(origin + vec3(0.05f * float(i) - 10.0f, 0.0f, 0.1f));
            normals.emplace_back(0, 1, 0);
        }
        for (const float height : {2.0f, 0.25f}) {
            scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), level_quad(-0.5f, 0.5f, -0.5f, 0.5f, height)});
            for (scene::Instance& i : s.instances) i.world_from_object = glm::translate(mat4(1), origin);
            const truth::Tracer tracer(s);
            const vec3 lamp = origin + vec3(0, height, 0);
            for (const scene::LightShape& shape : {scene::LightShape(scene::RectLight{lamp, vec3(0.5f, 0, 0), vec3(0, 0, 0.5f)}),
                     scene::LightShape(scene::DiskLight{lamp, vec3(0, -1, 0), 0.4f}),
                     scene::LightShape(scene::PointLight{lamp + vec3(0.1f, 0, 0.1f), 0.0f})}) {
                const std::vector<double> v = tracer.visibility_at(points, normals, light_of(shape), {});
                EXPECT_EQ(*std::min_element(v.begin(), v.end()), 1.0) << height << " " << shape.index() << " " << origin.x;
            }
        }
    }
}

TEST(TruthSelfShadow, a_tilted_lamp_whose_corners_are_rounded_does_not_block_its_light)
{
    for (const vec3 centre : {vec3(0.1f, 2.03f, 0.2f), vec3(310.7f, 22.3f, -170.9f)}) {
        const vec3 u(0.45f, 0.2f, 0.03f), v(0.01f, 0.02f, 0.5f);
        scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), quad(centre - u - v, centre + u - v, centre + u + v, centre - u + v)});
        const vec3 floor = centre - vec3(0, 2.03f, 0);
        s.instances[0].world_from_object = glm::translate(mat4(1), floor);
        std::vector<vec3> points, normals;
        for (int i = 0; i < 400; ++i) {
            points.push_back(floor + vec3(0.03f * float(i) - 3.0f, 0.0f, 0.1f));
            normals.emplace_back(0, 1, 0);
        }
        const truth::Tracer tracer(s);
        const std::vector<double> seen = tracer.visibility_at(points, normals, light_of(scene::RectLight{centre, u, v}), {});
        EXPECT_EQ(*std::min_element(seen.begin(), seen.end()), 1.0) << centre.x;
    }
}

TEST(TruthSelfShadow, a_thin_gap_still_casts_a_shadow)
{
    // The offset is some micrometres here; a plate a tenth of a millimetre above the floor must be felt.
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), level_quad(-1, 1, -1, 1, 1e-4f)});
    const truth::Tracer tracer(s);
    EXPECT_EQ(tracer.visibility_at({vec3(0.3f, 0, 0.2f)}, {vec3(0, 1, 0)}, light_of(scene::DirectionalLight{}), {})[0], 0.0);
    const scene::View view = look(s, {0, 3e-5f, 2}, {0, 3e-5f, 0}, {4, 4}, 1e-3f);
    EXPECT_EQ(tracer.primary(view).primitive[0], truth::no_primitive);
}
