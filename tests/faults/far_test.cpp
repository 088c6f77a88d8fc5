// SPDX-License-Identifier: Apache-2.0
// A scene that lies 100 km from the origin looks as it does at the origin, to techniques and to the truth.
#include "lab/render.h"
#include "reliability.h"
#include "scene/rebase.h"
#include "tests/gpu/device_fixture.h"
#include "truth/truth.h"

#include <fmt/format.h>

#include <cmath>

namespace gnomon::tests {
namespace {

using testing::Values;

enum class Moved { instances, vertices };

const vec3 far_away(100000.0f, -2048.0f, 65536.0f);

class Far : public gpu::DeviceTest, public testing::WithParamInterface<std::tuple<Moved, const char*, const char*>> {
protected:
    /// The coordinates of the scene as floats far away hold them: steps of 1/128 m and more.
    static lab::Stage near_stage()
    {
        lab::Stage stage = lab::open_stage({.scene = "contact", .load = {.detail = 0.2}, .lights = {light()}, .size = {128, 96}});
        scene::Scene& s = stage.scene;
        if (std::get<0>(GetParam()) == Moved::instances)
            for (scene::Instance& i : s.instances) i.world_from_object[3] = held_far_away(i.world_from_object[3]);
        else
            put_transforms_into_vertices(s);
        stage.bounds = s.bounds();
        return stage;
    }
    static vec4 held_far_away(vec4 p) { return glm::round(p * 64.0f) / 64.0f; }
    static void put_transforms_into_vertices(scene::Scene& s)
    {
        std::vector<scene::Mesh> meshes;
        for (scene::Instance& i : s.instances) {
            scene::Mesh mesh = s.meshes[size_t(i.mesh)];
            for (vec3& p : mesh.positions) p = vec3(held_far_away(i.world_from_object * vec4(p, 1)));
            mesh.normals.clear();
            scene::complete(mesh);
            i = {int(meshes.size()), mat4(1)};
            meshes.push_back(mesh);
        }
        s.meshes = meshes;
    }
    static const char* light() { return std::get<2>(GetParam()); }

    /// The same, moved away, as a file would have it, and opened.
    static lab::Stage far_stage(const lab::Stage& near)
    {
        lab::Stage stage = near;
        if (std::get<0>(GetParam()) == Moved::vertices)
            for (scene::Mesh& mesh : stage.scene.meshes) {
                for (vec3& p : mesh.positions) p += far_away;
                mesh.bounds.min += far_away, mesh.bounds.max += far_away;
            }
        else
            for (scene::Instance& i : stage.scene.instances) i.world_from_object[3] += vec4(far_away, 0);
        stage.origin = scene::far_origin(stage.scene);
        EXPECT_NE(stage.origin, vec3(0));
        scene::rebase(stage.scene, stage.origin);
        stage.bounds = stage.scene.bounds();
        // as their words on a command line would be read
        const vec3 shift = vec3(glm::dvec3(far_away) - glm::dvec3(stage.origin));
        stage.camera.eye += shift, stage.camera.target += shift;
        scene::Scene lights;
        lights.lights = stage.lights;
        scene::rebase(lights, -shift);
        stage.lights = lights.lights;
        stage.view = scene::make_view(stage.camera, stage.view.size, stage.bounds);
        return stage;
    }

    static base::Picture draw(const lab::Stage& stage)
    {
        shadow::SceneGpu scene(device(), stage.scene);
        return lab::render(device(), scene, stage, lab::parse_choice(std::get<1>(GetParam())), {.lit = false}).images.front();
    }
    static base::Picture trace(const lab::Stage& stage)
    {
        const truth::Tracer tracer(stage.scene);
        return tracer.visibility(stage.view, tracer.primary(stage.view), stage.lights.front(), {.samples = 16}).mean;
    }

    /// All but a few pixels, on edges, where the last bits of a coordinate decide.
    void expect_same(const base::Picture& a, const base::Picture& b, const char* what)
    {
        size_t off = 0;
        double dark = 0;
        for (size_t i = 0; i < a.values.size(); ++i) off += std::abs(a.values[i] - b.values[i]) > 0.02f, dark += 1.0 - double(a.values[i]);
        EXPECT_GT(dark, 100.0) << what;
        EXPECT_LE(off, a.values.size() / 1000) << what;
        record("limits",
            {{"limit",
                 fmt::format("{} {:.0f} km from the origin, {}", std::get<0>(GetParam()) == Moved::instances ? "instances" : "vertices",
                     glm::length(far_away) / 1000.0f, what)},
                {"outcome", fmt::format("{} of {} pixels differ from those at the origin by more than 0.02", off, a.values.size())}});
    }
};

TEST_P(Far, TheSamePicture)
{
    const lab::Stage near = near_stage(), far = far_stage(near);
    EXPECT_LT(glm::length(far.bounds.centre()), 2.0f * far.bounds.radius());
    expect_same(trace(near), trace(far), "truth");
    expect_same(draw(near), draw(far), std::get<1>(GetParam()));
}

constexpr const char *sun = "sun,elevation=50,azimuth=35,angle=0", *rect = "rect,position=2/5/1,target=0/0/0,intensity=40";
INSTANTIATE_TEST_SUITE_P(Scenes, Far,
    Values(std::tuple(Moved::instances, "ray_traced", sun), std::tuple(Moved::vertices, "ray_traced", rect),
        std::tuple(Moved::instances, "shadow_volumes", sun), std::tuple(Moved::vertices, "shadow_map:fit=uniform", sun)),
    [](const auto& p) {
        const std::string choice = std::get<1>(p.param);
        return choice.substr(0, choice.find(':')) + (std::get<0>(p.param) == Moved::instances ? "_instances" : "_vertices");
    });

} // namespace
} // namespace gnomon::tests
