// SPDX-License-Identifier: Apache-2.0
#include "scene/rebase.h"

#include "scene/crop.h"
#include "scene/load.h"

#include <gtest/gtest.h>

namespace gnomon::scene {
namespace {

Scene square(vec3 at)
{
    Scene s;
    s.materials.emplace_back();
    Mesh mesh;
    mesh.positions = {vec3(-1, 0, -1), vec3(-1, 0, 1), vec3(1, 0.5f, 1), vec3(1, 0, -1)};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    complete(mesh);
    s.meshes.push_back(mesh);
    s.instances.push_back({0, glm::translate(mat4(1), at)});
    s.lights.push_back({.name = "lamp", .shape = PointLight{at + vec3(0, 4, 0), 0.1f}});
    s.lights.push_back({.name = "sun", .shape = DirectionalLight{}});
    s.cameras.push_back({.name = "front", .eye = at + vec3(0, 1, 8), .target = at});
    return s;
}

TEST(Rebase, BuiltInScenesStayAtTheirOrigin)
{
    for (const Builtin& b : builtins()) {
        const Scene s = load(std::string(b.name), {.detail = 0.05});
        EXPECT_EQ(far_origin(s), vec3(0)) << b.name;
        const Bounds before = s.bounds();
        Scene same = s;
        rebase(same, far_origin(same));
        EXPECT_EQ(same.bounds().min, before.min) << b.name;
    }
}

TEST(Rebase, AFarSceneIsMovedWithItsLightsAndCameras)
{
    const vec3 at(100000, 50, -100000);
    Scene s = square(at);
    const vec3 origin = far_origin(s);
    EXPECT_LT(glm::length(origin - at), 4.0f);
    rebase(s, origin);
    EXPECT_EQ(vec3(s.instances[0].world_from_object[3]), at - origin);
    EXPECT_EQ(std::get<PointLight>(s.lights[0].shape).position, at + vec3(0, 4, 0) - origin);
    EXPECT_EQ(std::get<DirectionalLight>(s.lights[1].shape).direction, DirectionalLight{}.direction);
    EXPECT_EQ(s.cameras[0].eye, at + vec3(0, 1, 8) - origin);
    EXPECT_EQ(far_origin(s), vec3(0)) << "once is enough";
}

TEST(Rebase, CoordinatesInTheMeshItselfLoseNothing)
{
    const vec3 at(131072, 0, 65536);
    Scene s = square(vec3(0)), far = s;
    for (vec3& p : far.meshes[0].positions) p += at;
    far.meshes[0].bounds = {};
    for (const vec3& p : far.meshes[0].positions) far.meshes[0].bounds.add(p);
    // turned about the far point: a float product would be off by millimetres
    const mat4 turned = glm::rotate(mat4(1), 0.5f, vec3(0, 1, 0));
    far.instances[0].world_from_object = turned;
    const vec3 origin = far_origin(far);
    rebase(far, origin);
    for (size_t i = 0; i < s.meshes[0].positions.size(); ++i) {
        const glm::dvec3 exact = glm::dvec3(glm::dmat4(turned) * glm::dvec4(glm::dvec3(s.meshes[0].positions[i]) + glm::dvec3(at), 1.0));
        const vec3 now = vec3(far.instances[0].world_from_object * vec4(far.meshes[0].positions[i], 1));
        EXPECT_LT(glm::length(glm::dvec3(now) + glm::dvec3(origin) - exact), 2e-6) << i;
    }
}

TEST(Rebase, WordsAreReadInDoublePrecision)
{
    const vec3 origin(131072, 0, 0);
    const Camera c = parse_camera("eye=131072.001/2/3,target=131073/0/0", {}, {}, origin);
    EXPECT_FLOAT_EQ(c.eye.x, 0.001f);
    EXPECT_EQ(c.target, vec3(1, 0, 0));
    const Light l = parse_light("spot,position=131072.25/4/0,target=131072.25/0/0", {}, {}, origin);
    EXPECT_EQ(std::get<SpotLight>(l.shape).position, vec3(0.25f, 4, 0));
    EXPECT_EQ(std::get<SpotLight>(l.shape).direction, vec3(0, -1, 0));
    Bounds bounds;
    bounds.add(vec3(-1)), bounds.add(vec3(1));
    EXPECT_EQ(parse_camera("fit", {}, bounds, origin).target, bounds.centre()) << "what is fitted is counted from there already";
}

TEST(Crop, RaysOfAPartAreThoseOfTheWhole)
{
    Bounds bounds;
    bounds.add(vec3(-1)), bounds.add(vec3(1));
    for (const float ortho : {0.0f, 2.0f}) {
        Camera camera = fit_camera(bounds);
        camera.half_height = ortho;
        const Size size{640, 360};
        const Crop crop{100, 40, {200, 150}};
        const View whole = make_view(camera, size, bounds), part = make_view(camera, size, bounds, vec2(0), &crop);
        EXPECT_EQ(part.size, crop.size);
        EXPECT_EQ(part.near, whole.near);
        for (const vec2 p : {vec2(0.5f), vec2(10.5f, 149.5f), vec2(199.5f, 3.5f)}) {
            const Ray a = view_ray(part, p), b = view_ray(whole, p + vec2(100, 40));
            EXPECT_LT(glm::length(a.origin - b.origin), 1e-5f);
            EXPECT_LT(glm::length(a.direction - b.direction), 1e-6f);
        }
    }
}

} // namespace
} // namespace gnomon::scene
