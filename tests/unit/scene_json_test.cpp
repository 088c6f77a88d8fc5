// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace gnomon::scene {
namespace {

namespace fs = std::filesystem;

class SceneJson : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = fs::path(testing::TempDir())
            / ("gnomon_scene_json_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path write(const std::string& text, const std::string& name = "scene.json") const
    {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    std::string error_of(const std::string& text) const
    {
        try {
            load_scene_json(write(text));
        } catch (const base::Error& error) {
            return error.what();
        }
        return "accepted";
    }

    fs::path folder_;
};

void expect_near(vec3 a, vec3 b, const std::string& what) { EXPECT_LT(glm::length(a - b), 1e-5f * (1.0f + glm::length(b))) << what; }

void expect_same(const Light& a, const Light& b)
{
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind(), b.kind());
    EXPECT_EQ(a.soft(), b.soft()) << a.name;
    EXPECT_EQ(a.intensity, b.intensity) << a.name;
    expect_near(a.color, b.color, a.name);
    for (vec2 u : {vec2(0.1f, 0.2f), vec2(0.9f, 0.4f), vec2(0.3f, 0.95f)})
        expect_near(vec3(light_point(a, vec3(1, 0, 2), u)), vec3(light_point(b, vec3(1, 0, 2), u)), a.name);
    if (const auto* spot = std::get_if<SpotLight>(&a.shape)) {
        const auto& other = std::get<SpotLight>(b.shape);
        EXPECT_NEAR(spot->inner_angle, other.inner_angle, 1e-6f);
        EXPECT_NEAR(spot->outer_angle, other.outer_angle, 1e-6f);
        expect_near(spot->direction, other.direction, a.name);
    }
}

TEST_F(SceneJson, RoundTripKeepsEveryBuiltinsCamerasAndLights)
{
    for (const Builtin& b : builtins()) {
        Scene scene = b.make(1.0);
        scene.tuning = true, scene.validation = true;
        scene.lights[0].intensity = 2.5f;
        scene.cameras[0].half_height = 3.0f, scene.cameras[0].near = 0.2f, scene.cameras[0].up = vec3(0, 0, -1);
        const Scene back = load_scene_json(write(scene_json_text(scene, b.name)));
        EXPECT_TRUE(back.tuning);
        EXPECT_TRUE(back.validation);
        EXPECT_EQ(back.name, "scene");
        EXPECT_EQ(back.triangle_count(), scene.triangle_count());
        ASSERT_EQ(back.lights.size(), scene.lights.size());
        ASSERT_EQ(back.cameras.size(), scene.cameras.size());
        for (size_t i = 0; i < scene.lights.size(); ++i) expect_same(back.lights[i], scene.lights[i]);
        for (size_t i = 0; i < scene.cameras.size(); ++i) {
            const Camera &c = back.cameras[i], &d = scene.cameras[i];
            EXPECT_EQ(c.name, d.name);
            EXPECT_EQ(c.eye, d.eye);
            EXPECT_EQ(c.target, d.target);
            EXPECT_EQ(c.up, d.up);
            EXPECT_EQ(c.half_height, d.half_height);
            EXPECT_EQ(c.near, d.near);
            EXPECT_NEAR(c.half_height > 0.0f ? 0.0f : c.fov_y, c.half_height > 0.0f ? 0.0f : d.fov_y, 1e-6f);
        }
    }
}

TEST_F(SceneJson, OwnEntriesComeFirstAndReplaceByName)
{
    const Scene scene = load_scene_json(write(
        R"({"model": "plane", "lights": [{"name": "lamp", "type": "point", "position": [1, 2, 3]}, {"type": "point", "position": [0, 1, 0]}]})"));
    ASSERT_GE(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].name, "lamp");
    EXPECT_EQ(std::get<PointLight>(scene.lights[0].shape).position, vec3(1, 2, 3));
    EXPECT_EQ(scene.lights[1].name, "light 2");
    EXPECT_EQ(std::count_if(scene.lights.begin(), scene.lights.end(), [](const Light& l) { return l.name == "lamp"; }), 1);
    EXPECT_EQ(scene.cameras.size(), load("plane").cameras.size());
}

TEST_F(SceneJson, DetailIsTheFilesUnlessAskedFor)
{
    const fs::path file = write(R"({"model": "balls", "detail": 2.25})");
    EXPECT_EQ(load_scene_json(file).triangle_count(), load("balls", {.detail = 2.25}).triangle_count());
    EXPECT_EQ(load_scene_json(file, {.detail = 0.25}).triangle_count(), load("balls", {.detail = 0.25}).triangle_count());
    EXPECT_EQ(load(file.string()).triangle_count(), load("balls", {.detail = 2.25}).triangle_count());
}

TEST_F(SceneJson, AimsByTargetOrDirection)
{
    const Scene scene = load_scene_json(write(R"({"model": "plane", "lights": [
        {"name": "a", "type": "spot", "position": [0, 4, 0], "target": [0, 0, 0], "cone_deg": 40, "inner_cone_deg": 30, "radius": 0.1},
        {"name": "b", "type": "rect", "position": [0, 1, 5], "direction": [0, 0, -2], "width": 2, "height": 1},
        {"name": "c", "type": "directional", "direction": [0, -3, 0], "angle_deg": 2, "color": [1, 0.5, 0], "intensity": 4}]})"));
    EXPECT_EQ(std::get<SpotLight>(scene.lights[0].shape).direction, vec3(0, -1, 0));
    const auto rect = std::get<RectLight>(scene.lights[1].shape);
    EXPECT_EQ(glm::normalize(glm::cross(rect.half_u, rect.half_v)), vec3(0, 0, -1));
    EXPECT_EQ(rect.half_u.y, 0.0f);
    EXPECT_NEAR(std::get<DirectionalLight>(scene.lights[2].shape).angular_radius, glm::radians(1.0f), 1e-7f);
    EXPECT_EQ(scene.lights[2].intensity, 4.0f);
}

TEST_F(SceneJson, MaterialsOfTheModelAreChangedByName)
{
    const auto named = [](const Scene& s, std::string_view name) {
        return *std::find_if(s.materials.begin(), s.materials.end(), [&](const Material& m) { return m.name == name; });
    };
    const Scene before = load("tree"), after = load_scene_json(write(R"({"model": "tree", "materials": [{"name": "leaves", "alpha": "blend",
        "color": [0.2, 0.4, 0.6], "opacity": 0.5, "textured": false, "double_sided": false, "roughness": 0.25, "metallic": 1, "transmission": 0.125},
        {"name": "bark", "alpha": "mask", "cutoff": 0.75}]})"));
    const Material leaves = named(after, "leaves"), bark = named(after, "bark");
    EXPECT_EQ(leaves.alpha, AlphaMode::blend);
    EXPECT_EQ(leaves.base_color, vec4(0.2f, 0.4f, 0.6f, 0.5f));
    EXPECT_EQ(leaves.base_color_texture.texture, -1);
    EXPECT_FALSE(leaves.double_sided);
    EXPECT_EQ(leaves.roughness, 0.25f);
    EXPECT_EQ(leaves.metallic, 1.0f);
    EXPECT_EQ(leaves.transmission, 0.125f);
    EXPECT_EQ(bark.alpha, AlphaMode::mask);
    EXPECT_EQ(bark.alpha_cutoff, 0.75f);
    EXPECT_EQ(bark.base_color, named(before, "bark").base_color) << "what is left out stays";
    EXPECT_EQ(bark.base_color_texture.texture, named(before, "bark").base_color_texture.texture);
}

TEST_F(SceneJson, ErrorsNameFilePlaceAndWayOut)
{
    struct Bad {
        std::string text, says;
    };
    const std::string light = R"({"model": "plane", "lights": [{"type": "spot", "position": [0, 4, 0], )";
    const std::string camera = R"({"model": "plane", "cameras": [{"eye": [0, 1, 5], "target": [0, 0, 0])";
    const Bad table[] = {
        {"", "no JSON"},
        {"{", "line 1"},
        {"[]", "its top"},
        {"{}", "'model' is missing"},
        {R"({"model": 3})", "/model: must be a text"},
        {R"({"model": "plane", "camera": []})", "/camera: unknown key 'camera'"},
        {R"({"model": "plane", "cameras": {}})", "/cameras: must be an array"},
        {R"({"model": "plane", "detail": 1e9})", "/detail: is"},
        {R"({"model": "plane", "tuning": 1})", "/tuning: must be true or false"},
        {R"({"model": "plane", "validation": "yes"})", "/validation: must be true or false"},
        {R"({"model": "other.json"})", "another scene file"},
        {R"({"model": "planee"})", "planee"},
        {light + R"("target": [0, 0, 0], "cone_deg": 400}]})", "/lights/0/cone_deg: is 400, outside its range 0.1 to 179"},
        {light + R"("target": [0, 0, 0], "cone": 40}]})", "/lights/0/cone: unknown key 'cone'"},
        {light + R"("target": [0, 0]}]})", "/lights/0/target: must be an array of three numbers"},
        {light + R"("target": [0, 0, "x"]}]})", "/lights/0/target/2: must be a number"},
        {light + R"("target": [0, 4, 0]}]})", "own position"},
        {light + R"("direction": [0, 0, 0]}]})", "zero length"},
        {light + R"("intensity": 1}]})", "either target or direction"},
        {light + R"("target": [0, 0, 0], "cone_deg": 10, "inner_cone_deg": 20}]})", "wider"},
        {R"({"model": "plane", "lights": [{"type": "laser"}]})", "unknown type 'laser'"},
        {R"({"model": "plane", "lights": [{}]})", "'type' is missing"},
        {R"({"model": "plane", "lights": [{"type": "rect", "position": [0, 1, 0], "direction": [0, -1, 0], "width": 1, "height": 1, "width_axis": [0, 1, 0]}]})",
            "/width_axis: runs along"},
        {R"({"model": "plane", "lights": [{"type": "point", "name": "a", "position": [0, 1, 0]}, {"type": "point", "name": "a", "position": [0, 1, 0]}]})",
            "/lights/1: the name 'a'"},
        {camera + R"(, "fov_deg": 50, "half_height": 2}]})", "either fov_deg"},
        {R"({"model": "tree", "materials": [{"name": "leafs"}]})", "/materials/0/name: unknown material 'leafs'"},
        {R"({"model": "tree", "materials": [{"name": "leaves", "alpha": "glass"}]})", "/materials/0/alpha: unknown alpha 'glass'"},
        {R"({"model": "tree", "materials": [{"name": "leaves", "opacity": 2}]})", "/materials/0/opacity: is 2"},
        {R"({"model": "tree", "materials": [{"alpha": "mask"}]})", "'name' is missing"},
        {camera + R"(, "fov": 50}]})", "/cameras/0/fov: unknown key"},
        {camera + R"(, "a/b~": 50}]})", "/cameras/0/a~1b~0:"},
        {R"({"model": "plane", "cameras": [{"eye": [0, 0, 0], "target": [0, 0, 0]}]})", "own eye"},
        {R"({"model": "plane", "cameras": [{"eye": [0, 0, 1e30], "target": [0, 0, 0]}]})", "/cameras/0/eye/2: is 1e+30"},
    };
    for (const Bad& bad : table) EXPECT_NE(error_of(bad.text).find(bad.says), std::string::npos) << bad.text << "\n" << error_of(bad.text);
    EXPECT_NE(error_of(R"({"model": 3})").find("scene.json"), std::string::npos);
    EXPECT_NE(error_of(std::string(100000, '[')).find("no JSON"), std::string::npos);
    EXPECT_NE(error_of(R"({"model": "plane", "time": 1e999})").find("no JSON: "), std::string::npos) << "a number that no double holds";
    EXPECT_THROW(load_scene_json(folder_ / "missing.json"), base::Error);
}

TEST_F(SceneJson, ConvertsAListOfScenes)
{
    const fs::path list = write(R"({"scenes": [{"name": "hall", "file": "hall.glb", "bounds": [[0, 0, 0], [1, 1, 1]],
        "cameras": [{"name": "door", "eye": [1, 2, 3], "target": [0, 0, 0], "fov_y_deg": 65}],
        "lights": [{"type": "directional", "direction": [0, -2, 0]}, {"type": "directional", "direction": [1, -1, 0]},
                   {"type": "sphere", "position": [0, 1, 0], "radius": 0.25}, {"type": "spot", "position": [0, 9, 0], "target": [0, 0, 0], "cone_deg": 75}]}]})",
        "list.json");
    const auto texts = convert_scene_list(list, "models");
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_EQ(texts[0].first, "hall");
    EXPECT_NE(texts[0].second.find("\"model\": \"models/hall.glb\""), std::string::npos) << texts[0].second;
    // What it writes is read again: with a built-in in place of the model.
    std::string text = texts[0].second;
    text.replace(text.find("models/hall.glb"), std::string("models/hall.glb").size(), "plane");
    const Scene scene = load_scene_json(write(text));
    ASSERT_GE(scene.lights.size(), 4u);
    EXPECT_EQ(scene.lights[0].name, "sun");
    EXPECT_EQ(scene.lights[1].name, "sun 2");
    EXPECT_EQ(std::get<PointLight>(scene.lights[2].shape).radius, 0.25f);
    EXPECT_NEAR(std::get<SpotLight>(scene.lights[3].shape).outer_angle, glm::radians(37.5f), 1e-6f);
    EXPECT_EQ(scene.cameras[0].name, "door");
    EXPECT_NEAR(scene.cameras[0].fov_y, glm::radians(65.0f), 1e-6f);
    EXPECT_THROW(convert_scene_list(write(R"({"scenes": [{"name": "x"}]})"), ""), base::Error);
    EXPECT_THROW(convert_scene_list(write(R"({})"), ""), base::Error);
}

TEST_F(SceneJson, ConvertsTheSharedList)
{
    const char* shared = std::getenv("GNOMON_SHARED");
    const fs::path list = (shared ? fs::path(shared) : fs::path(GNOMON_SOURCE) / ".." / "shared") / "scenes" / "scenes.json";
    if (!fs::exists(list)) GTEST_SKIP() << "no shared scenes beside the source; set GNOMON_SHARED";
    const auto texts = convert_scene_list(list, "shared");
    EXPECT_GE(texts.size(), 10u);
    for (const auto& [name, text] : texts) {
        EXPECT_NE(text.find("\"cameras\""), std::string::npos) << name;
        EXPECT_NE(text.find("shared/" + name), std::string::npos) << name;
    }
}

} // namespace
} // namespace gnomon::scene
