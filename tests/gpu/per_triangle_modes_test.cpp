// SPDX-License-Identifier: Apache-2.0
// Semitransparent casters of per_triangle_volumes, and its samples: closed forms and ray-traced transmittance.
#include "exact_suite.h"

#include "scene/load.h"
#include "truth/truth.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

extern const gnomon::shadow::TechniqueInfo technique_per_triangle_volumes;

namespace gnomon {
namespace {

constexpr double alpha = 1, rgb = 2, textured = 3, stochastic = 4;

scene::Material blended(vec4 color)
{
    scene::Material m;
    m.alpha = scene::AlphaMode::blend;
    m.base_color = color;
    m.double_sided = true;
    return m;
}

/// A floor under horizontal panes, one a colour, the first of them lowest.
scene::Scene panes(const std::vector<scene::Material>& glass)
{
    scene::Scene s = floor_scene(4);
    for (size_t k = 0; k < glass.size(); ++k) {
        gpu::add_quad(s, {0.01f * float(k % 7), 0.5f + 2.0f * float(k) / float(glass.size()), 0.02f * float(k % 5)}, 3);
        s.meshes.back().material = int(s.materials.size());
        s.materials.push_back(glass[k]);
    }
    return s;
}

class PerTriangleModes : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& v)
    {
        return TechniqueTest::draw(technique_per_triangle_volumes, s, camera, size, light, v);
    }

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

/// Cards with a texture of smooth colours and alphas; or only of alphas, which make shades of grey.
scene::Scene cards(scene::AlphaMode mode, double texels, bool colored = true)
{
    scene::Scene s = floor_scene(4);
    scene::Texture t;
    t.width = t.height = int(texels);
    for (double y = 0; y < 6.28; y += 6.28319 / texels)
        for (double x = 0; x < 6.28; x += 6.28319 / texels)
            for (const double v : {std::sin(2 * x), std::cos(3 * y + x), std::sin(2 * y), std::cos(3 * x) * std::sin(2 * y)})
                t.rgba.push_back(uint8_t(std::lround(127.5 + 127.0 * v)));
    s.textures.push_back(t);
    scene::Material m = blended(vec4(0.9f, 1, 0.8f, 0.9f));
    if (!colored) {
        m.base_color = vec4(1);
        for (size_t i = 0; i < t.rgba.size(); ++i)
            if (i % 4 != 3) s.textures[0].rgba[i] = 255;
    }
    m.alpha = mode;
    m.base_color_texture = {0, {1.2f, 0.3f, 0.1f}, {-0.2f, 0.9f, 0.4f}};
    if (mode == scene::AlphaMode::mask) m.transmission = 0.4f;
    s.materials.push_back(m);
    Uniform uniform(5);
    scene::Mesh mesh;
    mesh.material = 1;
    for (uint32_t k = 0; k < 12; ++k) {
        const vec3 centre = vec3(0, 1.6f, 0) + uniform.in_cube() * vec3(2, 1, 2), u = uniform.in_cube(), v = uniform.in_cube();
        for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
            mesh.positions.push_back(centre + corner.x * u + corner.y * v);
            mesh.uvs.push_back(corner * 0.7f);
            mesh.colors.push_back(colored ? 0xff000000u | uint32_t(uniform(0, 1) * 127) << 8 | 0x8040c0u : 0xffffffffu);
        }
        for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(4 * k + i);
    }
    add_mesh(s, mesh);
    return s;
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

/// Frames of one still picture: the frame's number is the only seed.
class PerTriangleStochastic : public PerTriangleModes {
protected:
    static constexpr gpu::Size size{40, 30};
    inline static const scene::Camera near{.eye = {2, 2.5f, 2.5f}, .target = {0, 0, 0}};
    static std::vector<std::vector<float>> frames(const scene::Scene& s, const char* text, double samples, uint32_t count)
    {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const scene::View view = scene::make_view(near, size, s.bounds());
        shadow::ParamValues params(technique_per_triangle_volumes.params());
        params.set("mode", stochastic), params.set("samples", samples), params.set("texture_level", 1.0);
        shadow::SceneGpu scene(device(), s);
        gpu::Image out = image("out", shadow::output_format(technique_per_triangle_volumes, params.bytes(), light), size);
        const std::unique_ptr<shadow::Technique> technique = technique_per_triangle_volumes.create(device());
        std::vector<std::vector<float>> result;
        for (uint32_t frame = 0; frame < count; ++frame) {
            gpu::PassList passes(device());
            const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
            technique->record(passes, {s, view, light, scene, g, passes.import(out), frame}, params.bytes());
            device().submit(std::move(passes));
            result.push_back(device().read_back(out).values);
        }
        return result;
    }
};

/// The mean over 256 seeds is the grey transmittance, as far as chance allows: of each pixel, of all together, and of neighbours, which
/// would stray together if their numbers were related.
TEST_F(PerTriangleStochastic, TheMeanOverSeedsIsTheTransmittance)
{
    constexpr uint32_t count = 256;
    const scene::Scene s = cards(scene::AlphaMode::blend, 8, false);
    const char* light = "sun,elevation=70,azimuth=20,angle=0";
    const std::vector<float> exact = draw(s, near, size, light, {{"mode", textured}, {"texture_level", 1}});
    const std::vector<std::vector<float>> got = frames(s, light, 0, count);
    EXPECT_EQ(got[3], frames(s, light, 0, 4)[3]);
    EXPECT_NE(got[3], got[4]);
    double sum = 0, variance = 0, chi = 0, together = 0;
    size_t beyond = 0, random = 0;
    double last = 0;
    for (size_t i = 0; i < exact.size(); i += 4) {
        double mean_got = 0;
        for (const std::vector<float>& frame : got) {
            EXPECT_TRUE(frame[i] == 0.0f || frame[i] == 1.0f);
            mean_got += double(frame[i]) / count;
        }
        const double p = double(exact[i]), sigma = std::sqrt(p * (1 - p) / count);
        if (sigma < 1e-3) {
            EXPECT_NEAR(mean_got, p, 0.02);
            continue;
        }
        const double off = (mean_got - p) / sigma;
        beyond += std::abs(off) > 3;
        sum += mean_got - p, variance += sigma * sigma, chi += off * off, together += off * last;
        last = off;
        ++random;
    }
    ASSERT_GT(random, 150u);
    EXPECT_LE(double(beyond), 0.0027 * double(random) + 3 * std::sqrt(0.0027 * double(random)));
    EXPECT_LT(std::abs(sum), 3 * std::sqrt(variance));
    EXPECT_LT(std::abs(chi - double(random)), 3 * std::sqrt(2 * double(random)));
    EXPECT_LT(std::abs(together), 3 * std::sqrt(double(random)));
}

/// Of a pixel's 4 or 16 samples under a pane of one quarter, each is in a stratum of its own: exactly a quarter are dark.
TEST_F(PerTriangleStochastic, TheSamplesOfAPixelAreStratified)
{
    scene::Scene s = panes({blended(vec4(0, 0, 0, 0.25f))});
    s.materials[1].base_color = vec4(1, 1, 1, 0.25f);
    const char* light = "sun,elevation=80,azimuth=10,angle=0";
    for (const double samples : {1.0, 2.0}) {
        const std::vector<std::vector<float>> got = frames(s, light, samples, 4);
        const std::vector<float> exact = draw(s, near, size, light, {{"mode", rgb}, {"samples", samples}});
        size_t under = 0, diagonal = 0; // where two triangles share a pixel's samples, each draws its own numbers
        for (const std::vector<float>& frame : got)
            for (size_t i = 0; i < exact.size(); i += 4) {
                if (std::abs(exact[i] - 0.75f) > 1e-5f) continue;
                ++under;
                diagonal += frame[i] != 0.75f;
            }
        EXPECT_GT(under, 1000u);
        EXPECT_LT(double(diagonal), 0.05 * double(under));
    }
}

/// The very samples of a picture of so many times the size.
TEST_F(PerTriangleModes, SamplesAreThePixelsOfALargerPicture)
{
    scene::Scene s = soup(9, 120);
    s.materials.push_back(blended(vec4(0.9f, 0.4f, 0.2f, 0.6f)));
    add_mesh(s, soup(10, 60).meshes[1]);
    s.meshes.back().material = 1;
    const char* light = "point,position=0.5/3.5/0.8,radius=0";
    for (const double mode : {0.0, rgb})
        for (const int side : {2, 4}) {
            const int channels = mode == 0.0 ? 1 : 4;
            const std::vector<float> fine = draw(s, oblique, {48 * side, 32 * side}, light, {{"mode", mode}});
            const std::vector<float> got = draw(s, oblique, {48, 32}, light, {{"mode", mode}, {"samples", side == 2 ? 1.0 : 2.0}});
            double worst = 0;
            size_t partly = 0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 48; ++x) {
                    double sum = 0;
                    for (int k = 0; k < side * side; ++k)
                        sum += double(fine[size_t(((y * side + k / side) * 48 * side + x * side + k % side) * channels)]);
                    const double value = double(got[size_t((y * 48 + x) * channels)]);
                    worst = std::max(worst, std::abs(value - sum / (side * side)));
                    partly += value > 0.01 && value < 0.99;
                }
            EXPECT_LT(worst, 1e-6);
            EXPECT_GT(partly, 50u);
        }
}

/// The 32 positions of each pixel by the double-precision test of the plane's own points, where that plane fills the pixel.
class PerTriangleExtrapolated : public ExactTest { };

TEST_F(PerTriangleExtrapolated, PositionsOnThePixelsPlaneAreAsRaysFindThem)
{
    const scene::Scene s = soup(31, 90);
    const gpu::Size size{72, 48};
    const scene::View view = scene::make_view(oblique, size, s.bounds());
    for (const char* text : {"sun,elevation=55,azimuth=20,angle=0", "point,position=0.6/4.5/1,radius=0"}) {
        const HardTruth truth(s, scene::parse_light(text, {}, s.bounds()));
        const std::vector<Seen> seen = receivers(truth, s, oblique, size);
        const std::vector<float> got = draw({technique_per_triangle_volumes, "", {{"samples", 3}}}, s, oblique, size, text);
        size_t wrong = 0, partly = 0, unknown = 0, judged = 0;
        for (int y = 1; y + 1 < size.height; ++y)
            for (int x = 1; x + 1 < size.width; ++x) {
                const size_t i = size_t(y * size.width + x);
                bool whole = seen[i].own != SIZE_MAX && seen[i].facing > 0.1;
                for (int k = 0; k < 9; ++k) whole = whole && seen[size_t((y + k / 3 - 1) * size.width + x + k % 3 - 1)].own == seen[i].own;
                if (!whole) continue;
                int lit = 0, doubtful = 0;
                const Triangle& t = truth.triangles()[seen[i].own];
                for (int k = 0; k < 32; ++k) {
                    const scene::Ray ray
                        = scene::view_ray(view, vec2(float(x), float(y)) + vec2((float(k % 8) + 0.5f) / 8, (float(k / 8) + 0.5f) / 4));
                    const double along = glm::dot(seen[i].n, t[0] - dvec3(ray.origin)) / glm::dot(seen[i].n, dvec3(ray.direction));
                    const Verdict v = truth.at(dvec3(ray.origin) + along * dvec3(ray.direction), seen[i].n, seen[i].own);
                    lit += v == Verdict::lit, doubtful += v == Verdict::unknown;
                }
                const int found = int(std::lround(got[i] * 32));
                wrong += found < lit || found > lit + doubtful;
                partly += found > 0 && found < 32;
                unknown += size_t(doubtful), ++judged;
            }
        // Within a pixel, a triangle that stands on the surface darkens only what is behind it together with the pixel's centre.
        EXPECT_LE(wrong, 2u) << text;
        EXPECT_GT(partly, 40u);
        EXPECT_GT(judged, 1000u);
        EXPECT_LT(double(unknown), 0.02 * 32 * double(judged));
    }
}

} // namespace
} // namespace gnomon
