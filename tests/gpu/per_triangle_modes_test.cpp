// SPDX-License-Identifier: Apache-2.0
// Semitransparent casters of per_triangle_volumes: closed forms and ray-traced transmittance.
#include "per_triangle_fixture.h"

#include "scene/load.h"
#include "truth/truth.h"

#include <algorithm>
#include <numeric>

namespace gnomon {
namespace {

using namespace per_triangle_mode;

class PerTriangleModes : public PerTriangleTest {
protected:
    /// Of the whole picture, which the panes shade all over.
    static std::vector<float> under(const scene::Scene& s, double mode)
    {
        return draw(s, gpu::camera_above({0, 0, 0}, 0.4f, 1), {48, 40}, "sun,elevation=80,azimuth=10,angle=0", {{"mode", mode}});
    }

    static void expect_all(const std::vector<float>& got, vec3 want, double within)
    {
        double worst = 0;
        for (size_t i = 0; i < got.size(); ++i)
            if (i % 4 != 3) worst = std::max(worst, std::abs(double(got[i]) - double(want[int(i % 4)])));
        EXPECT_LE(worst, within) << want.x << " " << want.y << " " << want.z;
    }
};

TEST_F(PerTriangleModes, StackedPanesMultiply)
{
    Uniform uniform(1);
    for (const int count : {1, 2, 5, 12, 40}) {
        std::vector<scene::Material> grey, colored;
        vec3 product(1), colors(1);
        for (int k = 0; k < count; ++k) {
            const float a = uniform(0.01f, count > 5 ? 0.1f : 0.7f);
            grey.push_back(blended(vec4(vec3(uniform(0, 1)), a)));
            product *= scene::transmittance(grey.back(), grey.back().base_color);
            const vec3 tint = 0.5f + 0.5f * uniform.in_cube();
            colored.push_back(blended(vec4(tint, a)));
            colors *= scene::transmittance(colored.back(), colored.back().base_color);
        }
        expect_all(under(panes(grey), alpha), product, 2e-6);
        expect_all(under(panes(grey), rgb), product, 2e-6);
        expect_all(under(panes(colored), rgb), colors, 2e-6);
        expect_all(under(panes(colored), textured), colors, 2e-6);
    }
}

TEST_F(PerTriangleModes, ManyOrOpaquePanesAreDarkAndNothingWrapsAround)
{
    for (const double mode : {alpha, rgb, textured}) {
        expect_all(under(panes(std::vector(700, blended(vec4(0.2f, 0.5f, 0.9f, 0.6f)))), mode), vec3(0), 0);
        expect_all(under(panes({blended(vec4(1, 1, 1, 0.3f)), blended(vec4(1, 1, 1, 1))}), mode), vec3(0), 0);
        expect_all(under(panes(std::vector(9, blended(vec4(0.3f, 0.4f, 0.5f, 0)))), mode), vec3(1), 0);
    }
    // One channel may end while others go on.
    const std::vector<float> red = under(panes(std::vector(40, blended(vec4(1, 0, 0.5f, 0.02f)))), rgb);
    EXPECT_NEAR(double(red[0]), std::pow(0.98, 40), 1e-5);
    EXPECT_NEAR(double(red[1]), std::pow(0.98 * 0.98, 40), 1e-5);
}

TEST_F(PerTriangleModes, TheOrderOfTrianglesDoesNotChangeABit)
{
    for (const double mode : {alpha, rgb, textured}) {
        std::vector<float> first;
        for (uint32_t turn = 0; turn < 4; ++turn) {
            scene::Scene s = soup(21, 150);
            s.materials.push_back(blended(vec4(0.8f, 0.5f, 0.2f, 0.35f)));
            scene::Mesh& m = s.meshes[1];
            m.material = 1;
            std::vector<uint32_t> order(m.indices.size() / 3), indices;
            std::iota(order.begin(), order.end(), 0u);
            std::shuffle(order.begin(), order.end(), std::mt19937(turn));
            for (const uint32_t t : order)
                for (uint32_t k = 0; k < 3; ++k) indices.push_back(m.indices[3 * t + (k + turn) % 3]);
            if (turn) m.indices = indices;
            const std::vector<float> got = draw(s, oblique, {96, 64}, "point,position=0.4/4/0.8,radius=0", {{"mode", mode}});
            if (!turn) {
                first = got;
                EXPECT_LT(mean(first), 0.97);
            }
            EXPECT_TRUE(got == first) << mode << " " << turn;
        }
    }
}

/// The part of pixels whose samples or surfaces the two see differently is left to the mean.
double difference(const std::vector<float>& got, const truth::Visibility& want)
{
    double sum = 0;
    for (size_t i = 0; i < got.size() / 4; ++i)
        for (size_t c = 0; c < 3; ++c) sum += std::abs(double(got[4 * i + c]) - double(want.mean.values[3 * i + c]));
    return sum / (double(got.size()) * 0.75);
}

truth::Visibility traced(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const scene::Light& light)
{
    const truth::Tracer tracer(s);
    const scene::View view = scene::make_view(camera, size, s.bounds());
    return tracer.transmittance(view, tracer.primary(view), light, {});
}

TEST_F(PerTriangleModes, TexturesMatchRayTracing)
{
    const gpu::Size size{200, 150};
    for (const scene::AlphaMode mode : {scene::AlphaMode::blend, scene::AlphaMode::mask})
        for (const char* text : {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/4.5/1,radius=0"}) {
            const scene::Scene s = cards(mode, 8);
            const truth::Visibility want = traced(s, oblique, size, scene::parse_light(text, {}, s.bounds()));
            for (const double level : {0.0, 1.0}) {
                const std::vector<float> got = draw(s, oblique, size, text, {{"mode", textured}, {"texture_level", level}});
                EXPECT_LT(difference(got, want), level == 1.0 ? 1.0 / 1000 : 1.0 / 255) << text << ", level " << level;
                EXPECT_LT(mean(got), 0.985);
            }
            // What has one value for a whole triangle does not.
            EXPECT_GT(difference(draw(s, oblique, size, text, {{"mode", rgb}}), want), 1.0 / 255);
        }
}

/// A texture finer than pixels: the level of the footprint is nearer to the mean of many rays than one ray is.
TEST_F(PerTriangleModes, TheLevelOfTheFootprintAveragesFineTextures)
{
    const int side = 8;
    const gpu::Size size{60, 45}, fine{60 * side, 45 * side};
    const scene::Scene s = cards(scene::AlphaMode::blend, 512);
    for (const char* text : {"sun,elevation=70,azimuth=20,angle=0", "point,position=1/4.5/1,radius=0"}) {
        const truth::Visibility rays = traced(s, oblique, fine, scene::parse_light(text, {}, s.bounds()));
        truth::Visibility want{base::Picture(size, 3), {}, 1};
        for (int y = 0; y < fine.height; ++y)
            for (int x = 0; x < fine.width; ++x)
                for (int c = 0; c < 3; ++c) want.mean.at(x / side, y / side, c) += rays.mean.at(x, y, c) / float(side * side);
        const double footprint = difference(draw(s, oblique, size, text, {{"mode", textured}}), want);
        const double finest = difference(draw(s, oblique, size, text, {{"mode", textured}, {"texture_level", 1}}), want);
        EXPECT_LT(footprint, 0.85 * finest) << text;
    }
}

TEST_F(PerTriangleModes, BuiltInScenesMatchRayTracing)
{
    for (const char* name : {"stacked_panes", "tree", "fence"}) {
        const scene::Scene s = scene::load(name, {.detail = 0.5});
        const gpu::Size size{96, 72};
        const scene::Light* light = nullptr;
        for (const scene::Light& l : s.lights)
            if (!light && l.kind() == scene::LightKind::directional) light = &l;
        ASSERT_TRUE(light) << name;
        scene::Light hard = *light;
        std::get<scene::DirectionalLight>(hard.shape).angular_radius = 0;
        const truth::Visibility want = traced(s, s.cameras[0], size, hard);
        const std::vector<float> got
            = TechniqueTest::draw(technique_per_triangle_volumes, s, s.cameras[0], size, hard, {{"mode", textured}});
        EXPECT_LT(difference(got, want), 1.0 / 255) << name;
        EXPECT_LT(mean(got), 0.99) << name;
    }
}

} // namespace
} // namespace gnomon
