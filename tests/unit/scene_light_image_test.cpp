// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using scene::LightImage;

const Bounds bounds{vec3(-1), vec3(1)};

class LightImageFiles : public testing::Test {
protected:
    LightImageFiles()
        : folder_(fs::path(testing::TempDir()) / "gnomon_light_image")
    {
        fs::create_directories(folder_);
    }
    ~LightImageFiles() override
    {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    /// With one rectangle that has this image.
    scene::Scene scene_with(const std::string& image, const std::string& type = "rect") const
    {
        const std::string shape = type == "rect" ? R"("width": 1, "height": 1, "direction": [0, -1, 0])" : R"("radius": 1)";
        base::write_text(folder_ / "scene.json",
            R"({"model": "balls", "lights": [{"type": ")" + type + R"(", "position": [0, 3, 0], )" + shape + R"(, "image": )" + image
                + "}]}");
        return scene::load_scene_json(folder_ / "scene.json");
    }
    fs::path folder_;
};

std::string error_of(const std::function<void()>& f)
{
    try {
        f();
    } catch (const base::Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(LightImage, StandsUprightBeforeTheOneWhoLooks)
{
    const LightImage image = scene::make_light_image(2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, "corners");
    const auto strongest = [&](vec2 u) {
        const vec3 e = image.at(u);
        return e.x > 0 && e.y > 0 ? 3 : e.x > 0 ? 0 : e.y > 0 ? 1 : 2;
    };
    EXPECT_EQ(strongest({0.1f, 0.9f}), 0) << "texel (0, 0)";
    EXPECT_EQ(strongest({0.9f, 0.9f}), 1);
    EXPECT_EQ(strongest({0.1f, 0.1f}), 2);
    EXPECT_EQ(strongest({0.9f, 0.1f}), 3);
    EXPECT_EQ(strongest({0.0f, 1.0f}), 0) << "the border belongs to the image";
    // a light that shines along +z is seen by someone who looks along -z, with +x on the right and +y above
    const scene::Light light = scene::parse_light("rect,position=0/0/0,target=0/0/5", {}, bounds);
    const vec4 corner = scene::light_point(light, vec3(0, 0, 5), {0.0f, 1.0f});
    EXPECT_LT(corner.x, 0.0f);
    EXPECT_GT(corner.y, 0.0f);
}

TEST(LightImage, IsRelativeToItsMean)
{
    const LightImage image = scene::make_light_image(2, 1, {{4, 1, 0}, {0, 1, 0}}, "two");
    EXPECT_EQ(image.texels, (std::vector<vec3>{{2, 1, 1}, {0, 1, 1}})) << "a channel without light is 1";
    EXPECT_NEAR(image.tint.x, 2.0f, 1e-6f);
    EXPECT_NEAR(image.tint.y, 1.0f, 1e-6f);
    EXPECT_EQ(image.tint.z, 0.0f);
    const LightImage bright = scene::make_light_image(2, 1, {{4e6f, 1e6f, 0}, {0, 1e6f, 0}}, "the same, brighter");
    EXPECT_EQ(bright.texels, image.texels);
    EXPECT_EQ(bright.tint, image.tint);
}

TEST(LightImage, LargeOnesAreAveragedDown)
{
    std::vector<vec3> texels;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 130; ++x) texels.emplace_back(x < 65 ? 2 : 0, y, 1);
    const LightImage image = scene::make_light_image(130, 100, texels, "large");
    EXPECT_EQ(image.width, 64);
    EXPECT_EQ(image.height, 64);
    glm::dvec3 mean(0);
    for (const vec3 t : image.texels) mean += glm::dvec3(t) / 4096.0;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 1.0, 1e-5);
    EXPECT_NEAR(image.at({0.25f, 0.5f}).x, 2.0f, 1e-5f);
    EXPECT_NEAR(image.at({0.75f, 0.5f}).x, 0.0f, 1e-5f);
    EXPECT_NEAR(image.at({0.5f, 0.995f}).y, 0.36f / 49.5f, 1e-5f) << "row 0, and 0.5625 of row 1";
    EXPECT_NEAR(image.tint.y / image.tint.z, 49.5f, 1e-3f);
}

TEST(LightImage, BadEmissionIsRefused)
{
    const auto error = [](std::vector<vec3> texels) { return error_of([&] { scene::make_light_image(2, 1, texels, "NAME"); }); };
    EXPECT_NE(error({vec3(0), vec3(0)}).find("NAME is black everywhere"), std::string::npos);
    EXPECT_NE(error({vec3(0), vec3(1, -1, 0)}).find("-1"), std::string::npos);
    EXPECT_NE(error({vec3(0), vec3(1, std::numeric_limits<float>::quiet_NaN(), 0)}).find("nan"), std::string::npos);
    EXPECT_NE(error({vec3(0), vec3(std::numeric_limits<float>::infinity())}).find("inf"), std::string::npos);
    EXPECT_NE(error({vec3(1)}).find("1 texels instead of 2 x 1"), std::string::npos);
}

TEST(LightImage, BuiltinsHaveFewOrManyColours)
{
    for (const char* name : {"halves", "window", "glow"}) {
        const LightImage image = scene::load_light_image(name);
        ASSERT_EQ(image.texels.size(), size_t(image.width) * size_t(image.height)) << name;
        EXPECT_NEAR(image.tint.x + image.tint.y + image.tint.z, 3.0f, 1e-5f) << name;
    }
    EXPECT_TRUE(scene::load_light_image("none").empty());
}

TEST(LightImage, TheCommandLineNamesIt)
{
    const scene::Light light = scene::parse_light("rect,image=halves,width=2", {}, bounds);
    EXPECT_TRUE(light.textured());
    EXPECT_EQ(light.image.width, 2);
    scene::Light known = light;
    known.name = "lamp";
    EXPECT_TRUE(scene::parse_light("lamp,height=3", {known}, bounds).textured()) << "a light of the scene keeps its image";
    EXPECT_FALSE(scene::parse_light("lamp,image=none", {known}, bounds).textured());
    const auto error = [](const char* text) { return error_of([&] { scene::parse_light(text, {}, bounds); }); };
    EXPECT_NE(error("disk,image=halves").find("only rect lights have an image, not disk lights"), std::string::npos);
    EXPECT_NE(error("sun,image=halves").find("only rect lights"), std::string::npos);
    EXPECT_NE(error("rect,image=windwo").find("did you mean 'window'"), std::string::npos);
    EXPECT_NE(error("rect,image=not_there.png").find("not_there.png"), std::string::npos);
    EXPECT_NE(error("rect,image=list.txt").find(".png, .jpg or .exr"), std::string::npos);
}

TEST_F(LightImageFiles, PicturesAreReadAsTheyAreMeant)
{
    base::Picture p({2, 1}, 3);
    p.values = {0.5f, 0.25f, 0, 1, 0.25f, 0};
    base::write_png(folder_ / "p.png", p, base::Encoding::srgb);
    base::write_exr(folder_ / "p.exr", p, {"R", "G", "B"});
    base::Picture grey({2, 1}, 1);
    grey.values = {1, 3};
    base::write_exr(folder_ / "grey.exr", grey, {"Y"});
    base::write_exr(folder_ / "odd.exr", p, {"X", "Y", "Z"});
    for (const char* file : {"p.png", "p.exr"}) {
        const LightImage image = scene::load_light_image(file, folder_);
        EXPECT_NEAR(image.texels[0].x, 0.5f / 0.75f, 0.01f) << file;
        EXPECT_NEAR(image.texels[1].x, 1.0f / 0.75f, 0.01f) << file;
        EXPECT_NEAR(image.texels[1].y, 1.0f, 0.01f) << file;
        EXPECT_EQ(image.texels[1].z, 1.0f) << file;
    }
    EXPECT_EQ(scene::load_light_image("grey.exr", folder_).texels, (std::vector<vec3>{vec3(0.5f), vec3(1.5f)}));
    EXPECT_THROW(scene::load_light_image("odd.exr", folder_), base::Error);
    base::write_text(folder_ / "broken.png", "no picture");
    EXPECT_THROW(scene::load_light_image("broken.png", folder_), base::Error);
}

TEST_F(LightImageFiles, SceneFilesNameItOrHoldIt)
{
    base::Picture p({2, 1}, 3, 1.0f);
    p.values[0] = 0;
    base::write_png(folder_ / "beside.png", p, base::Encoding::srgb);
    const scene::Scene beside = scene_with(R"("beside.png")");
    EXPECT_EQ(beside.lights[0].image.width, 2) << "from the scene file's folder";
    EXPECT_EQ(scene_with(R"("halves")").lights[0].image.texels, scene::load_light_image("halves").texels);
    const scene::Scene rows = scene_with("[[[1, 0, 0], [0, 0, 1], [0, 3, 0]], [[0, 0, 1], [1, 0, 0], [1, 1, 1]]]");
    EXPECT_EQ(rows.lights[0].image.width, 3);
    EXPECT_EQ(rows.lights[0].image.height, 2);
    base::write_text(folder_ / "again.json", scene::scene_json_text(rows, "balls"));
    const LightImage again = scene::load_scene_json(folder_ / "again.json").lights[0].image;
    ASSERT_EQ(again.texels.size(), rows.lights[0].image.texels.size());
    for (size_t i = 0; i < again.texels.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(again.texels[i][c], rows.lights[0].image.texels[i][c], 1e-6f);
}

TEST_F(LightImageFiles, SceneFilesWithoutSenseSayWhere)
{
    const auto error
        = [&](const std::string& image, const std::string& type = "rect") { return error_of([&] { scene_with(image, type); }); };
    EXPECT_NE(error(R"("halves")", "point").find("is for rect lights only"), std::string::npos);
    EXPECT_NE(error("[[[1, 1, 1]], [[1, 1, 1], [1, 1, 1]]]").find("/lights/0/image/1: has 2 texels instead of 1"), std::string::npos);
    EXPECT_NE(error("[]").find("has no texels"), std::string::npos);
    EXPECT_NE(error("[[]]").find("has no texels"), std::string::npos);
    EXPECT_NE(error("[[[0, 0, 0]]]").find("black everywhere"), std::string::npos);
    EXPECT_NE(error("[[[0, -1, 0]]]"), "no error");
    EXPECT_NE(error("3"), "no error");
    EXPECT_NE(error(R"("absent.png")").find("absent.png"), std::string::npos);
}

} // namespace
} // namespace gnomon
