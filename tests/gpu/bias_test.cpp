// SPDX-License-Identifier: Apache-2.0
// What each kind of bias promises, on scenes of a few shapes, and where each is known to fail.
#include "technique_fixture.h"

#include "shadow/parts/bias.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_shadow_map;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;

constexpr double pi = 3.14159265358979;

/// A closed sphere of quads on a grid of angles.
void add_sphere(scene::Scene& s, vec3 centre, float radius)
{
    constexpr int around = 64, high = 32;
    scene::Mesh ball;
    for (int j = 0; j <= high; ++j)
        for (int i = 0; i < around; ++i) {
            const float a = 2 * float(pi) * float(i) / around, b = float(pi) * float(j) / high;
            ball.positions.push_back(radius * vec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)));
        }
    for (int j = 0; j < high; ++j)
        for (int i = 0; i < around; ++i) {
            const auto at = [&](int u, int v) { return uint32_t(v * around + u % around); };
            const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            ball.indices.insert(ball.indices.end(), {a, b, c, a, c, d});
        }
    scene::complete(ball);
    s.instances.push_back({int(s.meshes.size()), glm::translate(mat4(1), centre)});
    s.meshes.push_back(ball);
}

class Bias : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, Values values)
    {
        values.push_back({"fit", 0});
        return TechniqueTest::draw(technique_shadow_map, s, camera, size, light, values);
    }

    static double share_dark(const std::vector<float>& v)
    {
        return double(std::count_if(v.begin(), v.end(), [](float x) { return x < 0.999f; })) / double(v.size());
    }

    /// Linear depths of a map of two texels' reach around the floor, as draw_biased_map leaves them.
    static std::vector<double> depths(const scene::Scene& s, shaders::BiasParams bias, float reach, shadow::parts::DepthFormat format,
        float* texel = nullptr, int size = 64)
    {
        const Bounds bounds = s.bounds();
        const scene::View view = scene::make_view(camera_above(vec3(0), 3, 1), {8, 8}, bounds);
        const scene::Light light = scene::parse_light("sun,elevation=90,angle=0", {}, bounds);
        shadow::SceneGpu scene(device(), s);
        gpu::PassList passes(device());
        gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, {8, 8});
        const shadow::Frame frame{s, view, light, scene, {}, passes.import(out), 0};
        const shadow::parts::LightMap map
            = shadow::parts::draw_biased_map(passes, frame, {.size = size, .fitting = {.fit = 0}, .format = format}, bias, reach);
        gpu::Image kept = device().image(passes.desc(map.depth));
        passes.copy(map.depth, passes.import(kept));
        device().submit(std::move(passes));
        const shaders::LightMapLayer& layer = map.constants.layers[0];
        std::vector<double> depth;
        for (const float z : device().read_back(kept).values)
            depth.push_back(double(layer.far) - double(z) * double(layer.far - layer.near));
        if (texel) *texel = layer.texel_metres;
        return depth;
    }
};

struct Kind {
    const char* name;
    double index;
};
constexpr Kind flat{"constant", BIAS_CONSTANT}, cone{"cone", BIAS_CONE}, world{"texel_world", BIAS_TEXEL_WORLD},
    plane{"receiver_plane", BIAS_RECEIVER_PLANE}, normal{"normal_offset", BIAS_NORMAL_OFFSET};

TEST_F(Bias, TiltedPlanesDoNotShadowThemselvesUpTo85Degrees)
{
    const scene::Scene s = floor_scene(10);
    const scene::Camera camera{.eye = {0, 6, 9}, .target = {0, 0, 0}};
    size_t flat_fails = 0, swept = 0;
    for (int tilt = 0; tilt <= 85; tilt += 5) {
        const std::string light = "sun,elevation=" + std::to_string(90 - tilt) + ",azimuth=" + std::to_string(37 * tilt % 360) + ",angle=0";
        for (const Kind& kind : {cone, world, plane, normal})
            for (const double pcf : {1.0, 3.0, 9.0})
                for (const double d16 : {0.0, 1.0}) {
                    if (d16 != 0.0 && tilt > 80) continue; // 10 km of depth in 65536 steps is not the bias's to mend
                    EXPECT_EQ(share_dark(draw(s, camera, {64, 48}, light.c_str(),
                                  {{"bias", kind.index}, {"pcf", pcf}, {"map_size", 512}, {"depth", d16}, {"bilinear", d16}})),
                        0.0)
                        << kind.name << ", " << light << ", pcf " << pcf << ", d16 " << d16;
                }
        EXPECT_EQ(share_dark(draw(s, camera, {64, 48}, light.c_str(), {{"map_size", 512}})), 0.0) << "the default, " << light;
        // half a centimetre is an eighth of a texel
        flat_fails
            += share_dark(draw(s, camera, {64, 48}, light.c_str(), {{"bias", flat.index}, {"bias_constant", 0.005}, {"map_size", 512}}))
            > 0.2;
        ++swept;
    }
    EXPECT_GT(flat_fails, swept / 2);
}

TEST_F(Bias, PlanesUnderPointsAndSpotsDoNotShadowThemselves)
{
    const scene::Scene s = floor_scene(10);
    const scene::Camera camera{.eye = {0, 6, 9}, .target = {0, 0, 0}};
    const auto shadowed = [&](const char* light, const Kind& kind) {
        const std::vector<float> v = draw(s, camera, {96, 64}, light, {{"bias", kind.index}, {"map_size", 256}, {"bias_constant", 0}});
        // outside of a spot's cone it is wholly dark
        return double(std::count_if(v.begin(), v.end(), [](float x) { return x > 0.0f && x < 0.999f; }));
    };
    for (const char* light :
        {"point,position=1/2/0.5,radius=0", "point,position=-3/1.2/2,radius=0", "spot,position=4/3/1,target=-2/0/0,cone=80,radius=0"}) {
        for (const Kind& kind : {cone, world, plane}) EXPECT_EQ(shadowed(light, kind), 0.0) << kind.name << ", " << light;
        EXPECT_GT(shadowed(light, flat), 100.0) << light;
    }
}

TEST_F(Bias, ClosedSolidsNeedNoneWithTheirSecondSurface)
{
    scene::Scene s;
    s.materials.emplace_back();
    add_sphere(s, {0, 0, 0}, 1);
    for (const char* light :
        {"sun,elevation=60,azimuth=30,angle=0", "point,position=1/3/0.5,radius=0", "spot,position=1/3/0.5,target=0/0/0,cone=60,radius=0"}) {
        const auto acne = [&](double kind) { // where the light is not close to grazing
            const std::vector<float> v = draw(s, camera_above({0, 0, 0}, 3, 0.5f), {64, 64}, light,
                {{"bias", kind}, {"bias_constant", 0}, {"bias_scale", 0}, {"map_size", 256}});
            return share_dark(v);
        };
        EXPECT_EQ(acne(BIAS_SECOND_DEPTH), 0.0) << light;
        EXPECT_EQ(acne(BIAS_MIDPOINT), 0.0) << light;
        EXPECT_GT(acne(BIAS_CONSTANT), 0.2) << light;
        EXPECT_GT(acne(BIAS_DUAL_LAYERS), 0.2) << light << ": held to b, which is 0";
    }
}

TEST_F(Bias, OpenMeshesHaveNoSecondSurface)
{
    // A sheet that faces the light has no back: it casts no shadow. Nor is anything half-way behind a floor.
    scene::Scene s = floor_scene(4);
    add_quad(s, {-2, 1, 0}, 2);
    const char* noon = "sun,elevation=90,angle=0";
    const auto under = [&](double kind) { return mean(draw(s, camera_above({-1, 0, 0}, 0.5f, 0.2f), {16, 16}, noon, {{"bias", kind}})); };
    EXPECT_EQ(under(BIAS_SECOND_DEPTH), 1.0) << "known: the shadow of an open sheet is lost";
    EXPECT_EQ(under(BIAS_MIDPOINT), 0.0);
    EXPECT_EQ(under(BIAS_DUAL_LAYERS), 0.0);
    const scene::Scene open = floor_scene(10);
    const scene::Camera camera{.eye = {0, 6, 9}, .target = {0, 0, 0}};
    for (const double kind : {double(BIAS_MIDPOINT), double(BIAS_DUAL_LAYERS)}) {
        const auto floor = [&](const char* light, double scale) {
            return share_dark(draw(open, camera, {64, 48}, light, {{"bias", kind}, {"bias_scale", scale}, {"map_size", 256}}));
        };
        EXPECT_GT(floor("sun,elevation=40,azimuth=30,angle=0", 0), 0.3) << "one layer and no bias";
        EXPECT_EQ(floor("sun,elevation=40,azimuth=30,angle=0", 2), 0.0) << "b behind the only layer";
        EXPECT_GT(floor("sun,elevation=10,azimuth=30,angle=0", 2), 0.3) << "known: b does not follow the slope";
    }
}

TEST_F(Bias, LayersGiveTheDepthsTheyArePublishedWith)
{
    // A sheet 2 cm thick over one half of a floor, on which it lies a metre deep.
    scene::Scene s = floor_scene(4);
    add_quad(s, {-2, 1.00f, 0}, 2);
    add_quad(s, {-2, 0.98f, 0}, 2);
    scene::Scene gap = floor_scene(4);
    add_quad(gap, {-2, 1, 0}, 2);
    scene::Scene lone = floor_scene(1);
    add_quad(lone, {-3, 1, 0}, 1);
    for (const auto format : {shadow::parts::DepthFormat::d32, shadow::parts::DepthFormat::d16}) {
        const double step = format == shadow::parts::DepthFormat::d16 ? 1e-4 : 1e-5;
        float texel = 0;
        const auto offset = [&](const scene::Scene& scene, int kind, float b, float scale) {
            const std::vector<double> first = depths(scene, {BIAS_CONSTANT, 0, 1}, 2, shadow::parts::DepthFormat::d32);
            const std::vector<double> got = depths(scene, {kind, b, scale}, 2, format, &texel);
            const auto nearest = std::min_element(first.begin(), first.end());
            return got[size_t(nearest - first.begin())] - *nearest;
        };
        EXPECT_NEAR(offset(s, BIAS_DUAL_LAYERS, 0.1f, 0), 0.01, step) << "half of a thin sheet";
        EXPECT_NEAR(offset(s, BIAS_MIDPOINT, 0.1f, 0), 0.01, step);
        EXPECT_NEAR(offset(gap, BIAS_DUAL_LAYERS, 0.1f, 0), 0.1, step) << "b over a gap";
        EXPECT_NEAR(offset(gap, BIAS_MIDPOINT, 0.1f, 0), 0.5, step);
        EXPECT_NEAR(offset(gap, BIAS_DUAL_LAYERS, 0, 1), 2 * double(texel), step) << "reach texels";
        EXPECT_NEAR(offset(lone, BIAS_MIDPOINT, 0.1f, 0), 0.1, step) << "b behind the only layer";
    }
}

TEST_F(Bias, DualLayersDoNotLeakWhereMidpointsDo)
{
    // A shelf close under a sheet, far above the floor. Beside the shelf's edge, half-way between sheet and floor lies below the shelf:
    // a filter that looks over the edge finds it lit there.
    scene::Scene s = floor_scene(4);
    add_quad(s, {0, 1, 0}, 4);
    add_quad(s, {-2, 0.7f, 0}, 2);
    const auto lit = [&](double kind) { // the last texels before the edge, from below the sheet
        const scene::Camera camera{.eye = {-0.01f, 0.95f, 0}, .target = {-0.01f, 0, 0}, .up = {0, 0, -1}, .half_height = 0.005f};
        return mean(draw(s, camera, {8, 8}, "sun,elevation=90,angle=0", {{"bias", kind}, {"map_size", 256}, {"pcf", 5}}));
    };
    EXPECT_GT(lit(BIAS_MIDPOINT), 0.1);
    EXPECT_EQ(lit(BIAS_DUAL_LAYERS), 0.0);
}

TEST_F(Bias, IdsNeedNoBiasOnWhatIsTheirOwn)
{
    scene::Scene s = floor_scene(4);
    add_sphere(s, {0, 0.5f, 0}, 0.5f);
    const scene::Camera camera{.eye = {3, 3, -2}, .target = {0, 0.3f, 0}};
    const char* light = "sun,elevation=45,azimuth=90,angle=0";
    const auto image = [&](double kind, double scale) {
        return draw(s, camera, {128, 96}, light, {{"bias", kind}, {"bias_scale", scale}, {"bias_constant", 0}, {"map_size", 512}});
    };
    const std::vector<float> truth = image(BIAS_CONE, 1), ids = image(BIAS_IDS, 0), none = image(BIAS_CONSTANT, 0);
    size_t acne = 0, without = 0, lost = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
        acne += truth[i] == 1.0f && ids[i] < 0.5f, without += truth[i] == 1.0f && none[i] < 0.999f;
        lost += truth[i] == 0.0f && ids[i] > 0.5f;
    }
    EXPECT_EQ(acne, 0u);
    EXPECT_GT(without, truth.size() / 4);
    EXPECT_LT(lost, truth.size() / 200) << "the sphere's shadow on the floor";
    // Known: a mesh casts no shadow on itself. Both sheets of one mesh here.
    scene::Scene one;
    one.materials.emplace_back();
    scene::Mesh sheets;
    for (const float y : {0.0f, 1.0f})
        for (const vec3 p : {vec3(-2, y, -2), vec3(-2, y, 2), vec3(2, y, 2), vec3(2, y, -2)}) sheets.positions.push_back(p);
    sheets.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    scene::complete(sheets);
    one.meshes.push_back(sheets);
    one.instances.push_back({0, mat4(1)});
    const scene::Camera between = camera_above({0, 0, 0}, 0.5f, 0.5f);
    EXPECT_EQ(mean(draw(one, between, {16, 16}, "sun,elevation=90,angle=0", {{"bias", BIAS_IDS}})), 1.0);
    EXPECT_EQ(mean(draw(one, between, {16, 16}, "sun,elevation=90,angle=0", {{"bias", BIAS_CONE}})), 0.0);
}

TEST_F(Bias, ShadowsBeginWithinTwoTexelsOfAThinWall)
{
    // A wall of 1 mm, across the light. From above, the first dark pixel behind its foot; texels are as long on the floor as its slope
    // makes them.
    scene::Scene s = floor_scene(2);
    scene::Mesh wall;
    for (const float x : {-0.0005f, 0.0005f})
        for (const vec3 p : {vec3(x, 0, -1.5f), vec3(x, 0, 1.5f), vec3(x, 0.5f, 1.5f), vec3(x, 0.5f, -1.5f)}) wall.positions.push_back(p);
    wall.indices = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 3, 2, 6, 3, 6, 7};
    scene::complete(wall);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(wall);
    constexpr float width = 0.2f;
    constexpr int pixels = 400;
    for (const int elevation : {10, 20, 35, 50, 65, 75})
        for (const Kind& kind : {world, cone}) {
            // azimuth 90 shines along -x
            const std::string light = "sun,elevation=" + std::to_string(elevation) + ",azimuth=90,angle=0";
            const std::vector<float> v = draw(s, camera_above({-0.001f - 0.5f * width, 0, 0}, 3, 0.5f * width / pixels), {pixels, 1},
                light.c_str(), {{"bias", kind.index}, {"map_size", 1024}});
            int first = pixels;
            for (int i = 0; i < pixels && first == pixels; ++i)
                if (v[size_t(pixels - 1 - i)] < 0.5f) first = i;
            ASSERT_LT(first, pixels) << light << ": no shadow";
            const Bounds bounds = s.bounds();
            const shaders::LightMap map
                = shadow::parts::fit_light_map(s, bounds, scene::make_view(camera_above(vec3(0), 3, 1), {8, 8}, bounds),
                    scene::parse_light(light.c_str(), {}, bounds), {.size = 1024, .fitting = {.fit = 0}, .guard_texels = 3});
            const double texel = double(map.layers[0].texel_metres) / std::sin(elevation * pi / 180);
            EXPECT_LT(first * double(width) / pixels, 2 * texel) << kind.name << ", " << light;
        }
}

TEST_F(Bias, AnyAmountGivesVisibilities)
{
    scene::Scene s = gpu::half_shadowed();
    add_sphere(s, {1, 0.3f, 1}, 0.3f);
    const scene::Camera camera{.eye = {3, 2, 6}, .target = {0, 0, 0}};
    for (const char* light :
        {"sun,elevation=40,angle=0", "point,position=1/2/1,radius=0", "spot,position=3/3/1,target=0/0/0,cone=60,radius=0"})
        for (double kind = BIAS_CONSTANT; kind <= BIAS_IDS; ++kind)
            for (const double constant : {0.0, 2.0, 100.0})
                for (const double scale : {0.0, 1.0, 64.0})
                    for (const float v : draw(s, camera, {24, 16}, light,
                             {{"bias", kind}, {"bias_constant", constant}, {"bias_scale", scale}, {"map_size", 16},
                                 {"depth", scale > 1 ? 1 : 0}}))
                        ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << light << ", kind " << kind << ", " << constant << ", " << scale;
}

} // namespace
} // namespace gnomon
