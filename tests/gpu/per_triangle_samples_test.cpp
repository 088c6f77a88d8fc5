// SPDX-License-Identifier: Apache-2.0
// Several samples a pixel of per_triangle_volumes.
#include "per_triangle_fixture.h"

namespace gnomon {
namespace {

using namespace per_triangle_mode;

class PerTriangleSamples : public PerTriangleTest { };

float at(const std::vector<float>& picture, int x, int y, int width, int channels)
{
    return picture[(size_t(y) * size_t(width) + size_t(x)) * size_t(channels)];
}

/// The very samples of a picture of so many times the size.
TEST_F(PerTriangleSamples, SamplesAreThePixelsOfALargerPicture)
{
    scene::Scene s = soup(9, 120);
    s.materials.push_back(blended(vec4(0.9f, 0.4f, 0.2f, 0.6f)));
    add_mesh(s, soup(10, 60).meshes[1]);
    s.meshes.back().material = 1;
    const char* light = "point,position=0.5/3.5/0.8,radius=0";
    for (const double mode : {binary, rgb})
        for (const int side : {2, 4}) {
            const int channels = mode == binary ? 1 : 4;
            const std::vector<float> fine = draw(s, oblique, {48 * side, 32 * side}, light, {{"mode", mode}});
            const std::vector<float> got = draw(s, oblique, {48, 32}, light, {{"mode", mode}, {"samples", side == 2 ? 1.0 : 2.0}});
            double worst = 0;
            size_t partly = 0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 48; ++x) {
                    double sum = 0;
                    for (int k = 0; k < side * side; ++k)
                        sum += double(at(fine, x * side + k % side, y * side + k / side, 48 * side, channels));
                    const double value = double(at(got, x, y, 48, channels));
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
                const size_t i = size_t(y) * size_t(size.width) + size_t(x);
                bool whole = seen[i].own != SIZE_MAX && seen[i].facing > 0.1;
                for (int k = 0; k < 9; ++k)
                    whole
                        = whole && seen[i + size_t(k / 3) * size_t(size.width) + size_t(k % 3) - size_t(size.width) - 1].own == seen[i].own;
                if (!whole) continue;
                int lit = 0, doubtful = 0;
                const Triangle& t = truth.triangles()[seen[i].own];
                for (int k = 0; k < 32; ++k) {
                    const int column = k % 8, row = k / 8;
                    const vec2 within = (vec2(float(column), float(row)) + 0.5f) / vec2(8, 4);
                    const scene::Ray ray = scene::view_ray(view, vec2(float(x), float(y)) + within);
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
