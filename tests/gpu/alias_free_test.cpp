// SPDX-License-Identifier: Apache-2.0
// Every pixel against a test of every triangle in double precision, where the technique's lists are put to the test: lights in odd
// places, all samples on a line, triangles of no area, edges and corners right on samples.
#include "exact_suite.h"

extern const gnomon::shadow::TechniqueInfo technique_alias_free;

namespace gnomon {
namespace {

using gpu::camera_above;

constexpr double one = 0, eight = 1, thirty_two = 2;

class AliasFree : public ExactTest {
protected:
    static ExactSubject with(const Values& values) { return {technique_alias_free, "", values}; }
    static std::vector<float> draw(
        const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values)
    {
        return ExactTest::draw(with(values), s, camera, size, light);
    }
    static void expect_right(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values,
        size_t least_dark = 100, size_t least_lit = 100, double most_unknown = 0.04)
    {
        ExactTest::expect_right(with(values), s, camera, size, light, least_dark, least_lit, most_unknown);
    }
};

TEST_F(AliasFree, RandomTrianglesHaveNoWrongPixel)
{
    const char* lights[] = {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/2.5/1,radius=0",
        "spot,position=5/6/2,target=0/0/0,cone=50,radius=0", "sun,elevation=12,azimuth=200,angle=0", "point,position=-1/9/2,radius=0"};
    for (uint32_t seed = 0; seed < 60; ++seed)
        expect_right(soup(seed, 40 + int(seed % 3) * 60), oblique, {64, 48}, lights[seed % 5],
            {{"grid", 16 << (seed % 4)}, {"grid_fit", seed % 3}}, 20, 20);
}

TEST_F(AliasFree, LightsInExtremePlacesAreExact)
{
    const scene::Scene s = soup(7, 100);
    for (const char* light : {"point,position=0/0.7/0,radius=0", // among the triangles, in the frustum
             "point,position=4/4/6,radius=0", // at the eye
             "point,position=4.3/5/5,radius=0", // beside it, in the picture's plane
             "point,position=0/0.001/0,radius=0", // a millimetre above the floor
             "sun,direction=-4/-3.5/-6,angle=0", // down the view's axis
             "spot,position=8/7.5/12,target=0/0.5/0,cone=40,radius=0", // the same
             "sun,direction=4/-0.5/6,angle=0", // towards the eye
             "sun,elevation=90,angle=0", "sun,elevation=0.5,azimuth=30,angle=0"}) {
        expect_right(s, oblique, {96, 64}, light, {}, 0, 0, 0.5);
        expect_right(s, oblique, {96, 64}, light, {{"grid", 37}, {"grid_fit", 0}}, 0, 0, 0.5);
    }
}

TEST_F(AliasFree, TheGridDoesNotChangeABit)
{
    const scene::Scene s = soup(3, 120);
    for (const char* light :
        {"sun,elevation=40,azimuth=60,angle=0", "point,position=0.5/1.5/0.3,radius=0", "spot,position=4/5/1,target=0/0/0,cone=70,radius=0"})
        for (const double samples : {one, thirty_two}) {
            const std::vector<float> first = draw(s, oblique, {96, 64}, light, {{"samples", samples}, {"grid", 256}});
            EXPECT_GT(mean(first), 0.1);
            EXPECT_LT(mean(first), 0.99);
            EXPECT_EQ(first, draw(s, oblique, {96, 64}, light, {{"samples", samples}, {"grid", 256}})) << light << ", a second time";
            for (const double grid : {16.0, 64.0, 1024.0})
                for (const double fit : {0.0, 1.0, 2.0}) {
                    if (fit != 1.0 && (light[1] != 'u' || grid == 1024.0)) continue; // only the sun has fits
                    EXPECT_EQ(first, draw(s, oblique, {96, 64}, light, {{"samples", samples}, {"grid", grid}, {"grid_fit", fit}}))
                        << light << ", samples " << samples << ", grid " << grid << ", fit " << fit;
                }
        }
}

TEST_F(AliasFree, AllSamplesOnALineInLightSpaceAreExact)
{
    // a strip of floor that the sun's rays all but touch: in light space all samples lie within a cell's width
    const scene::Scene s = soup(5, 60);
    const scene::Camera strip{.eye = {0, 0.15f, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .half_height = 0.02f};
    expect_right(s, strip, {512, 2}, "sun,elevation=15,azimuth=90,angle=0", {}, 1, 1);
    // and one huge triangle between
    scene::Scene huge = floor_scene(2000);
    gpu::add_quad(huge, {-2000, 3, 0}, 2000);
    expect_right(huge, {.eye = {0, 2, 6}, .target = {0, 0, 0}}, {64, 48}, "sun,elevation=60,azimuth=80,angle=0", {}, 200, 200, 0.15);
}

/// Squares of a quarter metre over the floor, cut into triangles both ways, above an eye whose pixels have their centres on corners and
/// edges of them: not one may slip through.
TEST_F(AliasFree, CornersAndEdgesOnSamplesDoNotLeak)
{
    scene::Scene s = floor_scene(4);
    scene::Mesh m;
    const int n = 33;
    for (int z = 0; z < n; ++z)
        for (int x = 0; x < n; ++x)
            m.positions.push_back(
                {float(x - 16) * 0.25f + 0.0625f, 2 + 0.1f * float((x * 7 + z * 5) % 3), float(z - 16) * 0.25f + 0.0625f});
    for (int z = 0; z + 1 < n; ++z)
        for (int x = 0; x + 1 < n; ++x) {
            const auto a = uint32_t(z * n + x), b = a + 1, d = a + uint32_t(n), e = d + 1;
            const std::array<uint32_t, 6> cut = (x + z) % 2 ? std::array{a, d, b, b, d, e} : std::array{a, d, e, e, b, a};
            m.indices.insert(m.indices.end(), cut.begin(), cut.end());
        }
    scene::complete(m);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(m);
    // 64 pixels over 8 m: centres at odd sixteenths of a metre
    for (const double samples : {one, thirty_two})
        for (const char* light : {"sun,elevation=90,angle=0", "point,position=0.0625/6/0.0625,radius=0", "sun,direction=1/-1/0,angle=0"}) {
            const std::vector<float> got = draw(s, camera_above({0, 0, 0}, 1, 4), {64, 64}, light, {{"samples", samples}});
            size_t leaks = 0;
            for (int y = 0; y < 64; ++y)
                for (int x = 24; x < 62; ++x) leaks += y > 2 && y < 62 && got[size_t(y * 64 + x)] != 0.0f;
            EXPECT_EQ(leaks, 0u) << light;
        }
}

/// How many of the positions of a pixel (techniques/alias_free/alias_free_cells.glsl) the double-precision test finds lit, and how many
/// it cannot tell; on the floor, seen from `camera`.
struct Coverage {
    int lit = 0, unknown = 0;
};
Coverage coverage(const HardTruth& truth, const scene::View& view, int x, int y, int samples)
{
    const auto on_floor = [&](double px, double py) {
        const scene::Ray r = scene::view_ray(view, vec2(float(px), float(py)));
        return dvec3(r.origin) - dvec3(r.direction) * (double(r.origin.y) / double(r.direction.y));
    };
    Coverage c;
    for (int i = 0; i < samples; ++i) {
        const int bits = samples == 32 ? 5 : 3;
        int row = 0;
        for (int k = 0; k < bits; ++k) row |= (i >> k & 1) << (bits - 1 - k);
        const double a = (i + 0.5) / samples, b = ((row ^ (samples == 32 ? 18 : 4)) + 0.5) / samples;
        const Verdict v = truth.at(on_floor(x + a, y + b), dvec3(0, 1, 0), 0);
        c.lit += v == Verdict::lit;
        c.unknown += v == Verdict::unknown;
    }
    return c;
}

TEST_F(AliasFree, PositionsWithinAPixelAreAsRaysFindThem)
{
    scene::Scene s = soup(11, 80);
    for (vec3& p : s.meshes[1].positions) p.y += 4; // above the eye, which sees the floor alone
    const scene::Camera cameras[] = {camera_above({0, 0, 0}, 2, 3), {.eye = {2, 1.5f, 3}, .target = {0, 0, 0}}};
    for (int k = 0; k < 2; ++k)
        for (const char* text :
            {"sun,elevation=55,azimuth=20,angle=0", "point,position=1/9/1,radius=0", "spot,position=2/9/0,target=0/0/0,cone=30,radius=0"})
            for (const int samples : {8, 32}) {
                const gpu::Size size{48, 32};
                const scene::Light light = scene::parse_light(text, {}, s.bounds());
                const HardTruth truth(s, light);
                const scene::View view = scene::make_view(cameras[k], size, s.bounds());
                const std::vector<float> seen = surface(s, view).primitive;
                const std::vector<float> got = draw(s, cameras[k], size, text, {{"samples", samples == 8 ? eight : thirty_two}});
                size_t off = 0, partly = 0, unknown = 0;
                for (size_t i = 0; i < got.size(); ++i) {
                    if (seen[i] > 1.0f) continue;
                    const Coverage c = coverage(truth, view, int(i) % size.width, int(i) / size.width, samples);
                    const int lit = int(std::lround(got[i] * float(samples)));
                    // A perspective pixel is a trapezium, and its footprint a parallelogram.
                    const int slack = k == 0 ? 0 : 2;
                    off += lit < c.lit - slack || lit > c.lit + c.unknown + slack;
                    partly += lit > 0 && lit < samples;
                    unknown += size_t(c.unknown);
                }
                EXPECT_GT(partly, 50u) << text;
                EXPECT_LT(double(unknown), 0.03 * samples * size.area());
                EXPECT_EQ(off, 0u) << text << ", " << samples;
            }
}

/// A sheet with one straight edge, turned by all angles: what is lit of a pixel is a half-plane's part of a square.
TEST_F(AliasFree, AStraightEdgeCoversItsArea)
{
    double worst = 0, sum = 0;
    size_t count = 0;
    for (int turn = 0; turn < 12; ++turn) {
        const float angle = 0.1f + 0.13f * float(turn);
        scene::Scene s = floor_scene(4);
        s.instances.push_back({int(s.meshes.size()), glm::rotate(mat4(1), angle, vec3(0, 1, 0))});
        scene::Mesh sheet;
        sheet.positions = {{-9, 2, -9}, {-9, 2, 9}, {0.01f, 2, 9}, {0.01f, 2, -9}};
        sheet.indices = {0, 1, 2, 0, 2, 3};
        scene::complete(sheet);
        s.meshes.push_back(sheet);
        const std::vector<float> got
            = draw(s, camera_above({0, 0, 0}, 1, 1), {32, 32}, "sun,elevation=90,angle=0", {{"samples", thirty_two}});
        const vec3 n(glm::rotate(mat4(1), angle, vec3(0, 1, 0)) * vec4(1, 0, 0, 0));
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                int lit = 0;
                constexpr int fine = 64;
                for (int j = 0; j < fine * fine; ++j) {
                    const double px = (x + (j % fine + 0.5) / fine) / 16 - 1, pz = (y + (j / fine + 0.5) / fine) / 16 - 1;
                    lit += px * double(n.x) + pz * double(n.z) > 0.01;
                }
                const double area = double(lit) / (fine * fine), off = double(got[size_t(y * 32 + x)]) - area;
                worst = std::max(worst, std::abs(off));
                if (area > 0 && area < 1) sum += off, ++count;
            }
    }
    EXPECT_GT(count, 300u);
    EXPECT_LE(worst, 2.5 / 32);
    EXPECT_LT(std::abs(sum / double(count)), 2e-3);
}

const ExactSubject defaults{technique_alias_free, "defaults", {}, 60, 20}, few_cells{technique_alias_free, "few_cells", {{"grid", 16}}};
INSTANTIATE_TEST_SUITE_P(alias_free, ExactSoups, testing::Values(defaults), exact_name);
INSTANTIATE_TEST_SUITE_P(alias_free, ExactPlaces, testing::Values(defaults, few_cells), exact_name);
INSTANTIATE_TEST_SUITE_P(alias_free, ExactBadInput, testing::Values(defaults, few_cells), exact_name);

} // namespace
} // namespace gnomon
