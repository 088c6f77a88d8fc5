// SPDX-License-Identifier: Apache-2.0
// Masks of rectangles against containment sample by sample, and what masks are for: overlaps count once.
#include "device_fixture.h"
#include "light_samples.shared.h"

#include "shadow/parts/light_image.h"
#include "shadow/parts/light_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <set>

namespace gnomon {
namespace {

using shaders::HiddenCase;
using shaders::HiddenResult;
using shadow::parts::light_sample_grid;
using shadow::parts::LightSamples;
using Mask = std::array<uint32_t, 8>;

class LightSamplesTest : public gpu::DeviceTest {
protected:
    static std::vector<HiddenResult> hide(
        const LightSamples& samples, int words, const std::vector<HiddenCase>& cases, const scene::LightImage& image = {})
    {
        gpu::Buffer in = storage("cases", std::span(cases)), out = storage<HiddenResult>("results", cases.size());
        gpu::Buffer table = storage("table", std::span(samples.table));
        const std::vector<vec4> texels = image.empty() ? std::vector<vec4>(1) : shadow::parts::light_image_table(image, samples.cells);
        gpu::Buffer colors = storage("image", std::span(texels));
        const gpu::SpecConstant spec[] = {{0, uint32_t(words)}, {1, image.empty() ? 0u : 1u}};
        gpu::PassList list(device());
        gpu::ComputePass pass;
        pass.name = "hide";
        pass.program = &device().compute_program("tests/gpu/light_samples.comp", spec);
        pass.bindings = {{list.import(in), gpu::Use::load}, {list.import(out), gpu::Use::store}, {list.import(table), gpu::Use::load},
            {list.import(colors), gpu::Use::load}};
        pass.constants = uint32_t(cases.size());
        pass.threads = {uint32_t(cases.size()), 1, 1};
        list.compute(std::move(pass));
        device().submit(std::move(list));
        return values<HiddenResult>(out);
    }
};

/// On multiples of 1/1024, which the shader's arithmetic holds exactly: sides that run through samples are among them.
std::vector<HiddenCase> random_cases(size_t count)
{
    std::mt19937 random(3);
    const auto at = [&] { return float(int(random() % 2500) - 1250) / 1024.0f; };
    std::vector<HiddenCase> out(count);
    for (HiddenCase& c : out)
        for (vec4& r : c.rectangles) {
            const float x0 = at(), x1 = at(), y0 = at(), y1 = at();
            r = {std::min(x0, x1), std::min(y0, y1), std::max(x0, x1), std::max(y0, y1)};
        }
    return out;
}

Mask brute_force(const LightSamples& samples, const HiddenCase& c)
{
    Mask mask{};
    for (size_t i = 0; i < samples.cells.size(); ++i) {
        const vec2 p = (vec2(samples.cells[i]) + 0.5f) / (0.5f * light_sample_grid) - 1.0f;
        for (const vec4 r : c.rectangles)
            if (p.x >= r.x && p.x < r.z && p.y >= r.y && p.y < r.w) mask[i / 32] |= 1u << (i % 32);
    }
    return mask;
}

TEST_F(LightSamplesTest, MasksAreThoseOfContainment)
{
    const std::vector<HiddenCase> cases = random_cases(4000);
    for (const int count : {64, 256})
        for (const bool disk : {false, true}) {
            const LightSamples samples = shadow::parts::light_samples(count, disk);
            const auto results = hide(samples, count / 32, cases);
            for (size_t i = 0; i < cases.size(); ++i) {
                const Mask want = brute_force(samples, cases[i]);
                ASSERT_TRUE(std::equal(want.begin(), want.end(), results[i].mask)) << i << ", " << count << (disk ? ", disk" : "");
                int bits = 0;
                for (const uint32_t word : want) bits += std::popcount(word);
                ASSERT_EQ(results[i].visible, 1.0f - float(bits) / float(count));
                ASSERT_EQ(results[i].all, bits == count ? 1u : 0u);
            }
        }
}

TEST_F(LightSamplesTest, RepeatedRectanglesChangeMasksNotButAreas)
{
    const LightSamples samples = shadow::parts::light_samples(256, false);
    std::vector<HiddenCase> once = random_cases(100), twice = once;
    for (size_t i = 0; i < once.size(); ++i) once[i].rectangles[1] = vec4(5.0f), twice[i].rectangles[1] = twice[i].rectangles[0];
    const auto a = hide(samples, 8, once), b = hide(samples, 8, twice), area = hide(samples, 0, twice);
    for (size_t i = 0; i < once.size(); ++i) {
        ASSERT_EQ(a[i].visible, b[i].visible);
        double sum = 0;
        for (const vec4 r : twice[i].rectangles) {
            const vec4 inside = glm::clamp(r, vec4(-1), vec4(1));
            sum += double(inside.z - inside.x) * double(inside.w - inside.y);
        }
        ASSERT_NEAR(double(area[i].visible), std::max(0.0, 1.0 - 0.25 * sum), 1e-6);
    }
}

/// Red at the upper left, green at the upper right, and so on: no symmetry hides an exchange of axes or signs. No blue anywhere.
scene::LightImage lopsided()
{
    const vec3 r(1, 0, 0), g(0, 2, 0), y(0.5f, 0.5f, 0), o(0);
    return scene::make_light_image(3, 2, {r, y, g, o, g, y}, "lopsided");
}

TEST_F(LightSamplesTest, ColoursAreThoseOfTheSamplesThatAreLeft)
{
    const std::vector<HiddenCase> cases = random_cases(1000);
    const scene::LightImage image = lopsided();
    for (const int count : {64, 256}) {
        const LightSamples samples = shadow::parts::light_samples(count, false);
        const auto results = hide(samples, count / 32, cases, image);
        for (size_t i = 0; i < cases.size(); ++i) {
            glm::dvec3 left(0.0), all(0.0);
            for (size_t s = 0; s < samples.cells.size(); ++s) {
                const glm::dvec3 emitted(image.at((vec2(samples.cells[s]) + 0.5f) / float(light_sample_grid)));
                all += emitted;
                if (!(results[i].mask[s / 32] >> (s % 32) & 1u)) left += emitted;
            }
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(double(results[i].colors[c]), left[c] / all[c], 1e-5) << i << ", channel " << c;
            ASSERT_NEAR(results[i].colors.z, results[i].visible, 1e-5f) << "without blue light, blue counts samples";
        }
    }
}

TEST_F(LightSamplesTest, SummedColoursAreExact)
{
    std::vector<HiddenCase> cases = random_cases(1000);
    for (HiddenCase& c : cases) c.rectangles[1] = c.rectangles[2] = vec4(5.0f);
    const scene::LightImage image = lopsided();
    const auto results = hide(shadow::parts::light_samples(64, false), 0, cases, image);
    for (size_t i = 0; i < cases.size(); ++i) {
        const vec4 r = glm::clamp(cases[i].rectangles[0], vec4(-1), vec4(1)) * 0.5f + 0.5f;
        glm::dvec3 hidden(0.0);
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 3; ++x) {
                const double w = std::min(double(r.z), (x + 1) / 3.0) - std::max(double(r.x), x / 3.0);
                const double h = std::min(double(r.w), (y + 1) / 2.0) - std::max(double(r.y), y / 2.0);
                if (w > 0 && h > 0) hidden += w * h * glm::dvec3(image.at(vec2((float(x) + 0.5f) / 3.0f, (float(y) + 0.5f) / 2.0f)));
            }
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(double(results[i].colors[c]), 1.0 - hidden[c], 2e-6) << i << ", channel " << c;
    }
}

TEST_F(LightSamplesTest, FarAndInfiniteRectanglesAreHeld)
{
    const float far = 3e38f, infinite = std::numeric_limits<float>::infinity();
    const std::vector<HiddenCase> cases = {{{vec4(-far, -far, far, far), vec4(5), vec4(5)}},
        {{vec4(-infinite, -infinite, infinite, infinite), vec4(5), vec4(5)}}, {{vec4(far, -far, infinite, far), vec4(5), vec4(5)}}};
    for (const int words : {0, 2, 8}) {
        const auto results = hide(shadow::parts::light_samples(words == 8 ? 256 : 64, false), words, cases);
        EXPECT_EQ(results[0].visible, 0.0f);
        EXPECT_EQ(results[1].visible, 0.0f);
        EXPECT_EQ(results[2].visible, 1.0f);
    }
}

TEST(LightSamples, EverySideOfASquareLightPassesThemOneByOne)
{
    for (const int count : {64, 256}) {
        std::set<int> columns, rows;
        for (const glm::ivec2 c : shadow::parts::light_samples(count, false).cells)
            columns.insert(c.x * count / light_sample_grid), rows.insert(c.y * count / light_sample_grid);
        EXPECT_EQ(int(columns.size()), count);
        EXPECT_EQ(int(rows.size()), count);
    }
}

TEST(LightSamples, ADiskHoldsThemEvenly)
{
    for (const int count : {64, 256}) {
        const LightSamples samples = shadow::parts::light_samples(count, true);
        ASSERT_EQ(int(samples.cells.size()), count);
        for (int k = 0; k < 36; ++k) {
            const double angle = k * 3.14159265 / 18;
            // half planes at a distance q hide 1/2 - (q sqrt(1 - q^2) + asin q) / pi of a disk
            for (const double q : {0.0, 0.3, 0.6}) {
                double beyond = 0;
                for (const glm::ivec2 c : samples.cells) {
                    const vec2 p = (vec2(c) + 0.5f) / (0.5f * light_sample_grid) - 1.0f;
                    EXPECT_LT(glm::length(p), 1.01f);
                    beyond += double(p.x) * std::cos(angle) + double(p.y) * std::sin(angle) > q ? 1.0 / count : 0.0;
                }
                EXPECT_NEAR(beyond, 0.5 - (q * std::sqrt(1 - q * q) + std::asin(q)) / 3.14159265, count == 64 ? 0.05 : 0.025);
            }
        }
    }
}

} // namespace
} // namespace gnomon
