// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "window_cases.h"

#include "base/error.h"
#include "shadow/parts/summed_area_table.h"

namespace gnomon {
namespace {

using namespace tests;
namespace parts = shadow::parts;
constexpr const char* float_shader = "tests/gpu/window_mean_float.comp";
constexpr const char* integer_shader = "tests/gpu/window_mean_integer.comp";

class SummedAreaTable : public gpu::DeviceTest {
protected:
    static std::vector<vec4> float_means(const Layers& layers, const std::vector<shaders::WindowCase>& cases, float centre)
    {
        gpu::Image image = upload_layers(device(), layers);
        gpu::PassList list(device());
        const gpu::ImageId sums = parts::build_float_sums(list, list.import(image), layers[0].channels, vec4(centre));
        return run_image_cases<vec4>(std::move(list), float_shader, cases, {{sums, gpu::Use::sample}});
    }
    static std::vector<shaders::IntegerSums> integer_sums(const Layers& layers, const std::vector<shaders::WindowCase>& cases, int bits)
    {
        gpu::Image image = upload_layers(device(), layers);
        gpu::PassList list(device());
        const gpu::ImageId sums = parts::build_integer_sums(list, list.import(image), layers[0].channels, bits);
        return run_image_cases<shaders::IntegerSums>(
            std::move(list), integer_shader, cases, {{sums, gpu::Use::sample}}, parts::integer_sum_step(bits));
    }
};

/// The counts that the table holds, as values: exact in float up to 24 bits.
Layers quantised(Layers layers, int bits)
{
    for (auto& p : layers)
        for (float& v : p.values) v = std::nearbyint(std::clamp(v, 0.0f, 1.0f) * float((1 << bits) - 1));
    return layers;
}

uint64_t brute_force_sum(const base::Picture& counts, int channel, const shaders::WindowCase& c)
{
    const auto clipped = [](float v, int size) { return int(std::clamp(std::floor(v), 0.0f, float(size))); };
    uint64_t sum = 0;
    for (int y = clipped(c.lo.y, counts.size.height); y < clipped(c.hi.y, counts.size.height); ++y)
        for (int x = clipped(c.lo.x, counts.size.width); x < clipped(c.hi.x, counts.size.width); ++x)
            sum += uint64_t(counts.at(x, y, channel));
    return sum;
}

TEST_F(SummedAreaTable, FloatMeansAreThoseOfBruteForce)
{
    uint32_t seed = 1;
    for (const base::Size size : window_sizes)
        for (const int channels : {1, 2, 4}) {
            SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << ", " << channels << " channels");
            const Layers layers = random_layers(size, channels, channels == 2 ? 6 : 1, ++seed);
            const auto cases = random_windows(size, int(layers.size()), 300, ++seed);
            const float centre = channels == 1 ? 0.5f : 0.0f;
            const auto means = float_means(layers, cases, centre);
            for (size_t i = 0; i < cases.size(); ++i)
                for (int k = 0; k < 4; ++k) {
                    const double expected
                        = k < channels ? window_mean(layers[size_t(cases[i].layer)], k, cases[i].lo, cases[i].hi) - double(centre) : 0.0;
                    // entries of up to 5000 carry an error of up to some 1e-3, which one texel alone shows undivided
                    ASSERT_NEAR(double(means[i][k]), expected, 2e-3) << "case " << i << ", channel " << k;
                }
        }
}

TEST_F(SummedAreaTable, FloatSumsOfFewBitsAreExact)
{
    // All partial sums are whole numbers below 2^24.
    Layers layers = quantised(random_layers({200, 150}, 1, 2, 7), 8);
    std::vector<shaders::WindowCase> cases;
    for (const auto& c : random_windows({200, 150}, 2, 400, 8)) cases.push_back({c.layer, glm::floor(c.lo), glm::ceil(c.hi)});
    const auto means = float_means(layers, cases, 0.0f);
    for (size_t i = 0; i < cases.size(); ++i)
        ASSERT_FLOAT_EQ(means[i].x, float(window_mean(layers[size_t(cases[i].layer)], 0, cases[i].lo, cases[i].hi))) << i;
}

TEST_F(SummedAreaTable, CentringKeepsSingleTexelsPrecise)
{
    const base::Size size{512, 512};
    const Layers layers = random_layers(size, 1, 1, 9);
    std::vector<shaders::WindowCase> cases;
    for (int i = 0; i < 512; ++i) cases.push_back({0, {i, 511 - i / 8}, {i + 1, 512 - i / 8}});
    const auto worst = [&](float centre) {
        const auto means = float_means(layers, cases, centre);
        double most = 0;
        for (size_t i = 0; i < cases.size(); ++i)
            most = std::max(most, std::abs(double(means[i].x + centre) - window_mean(layers[0], 0, cases[i].lo, cases[i].hi)));
        return most;
    };
    const double plain = worst(0.0f), centred = worst(0.5f);
    RecordProperty("plain", std::to_string(plain));
    RecordProperty("centred", std::to_string(centred));
    EXPECT_LT(plain, 0.1);
    EXPECT_LT(centred, 1e-3);
    EXPECT_LT(centred * 10, plain);
}

TEST_F(SummedAreaTable, IntegerSumsAreExactThroughWrapAround)
{
    uint32_t seed = 20;
    for (const base::Size size : window_sizes)
        for (const int channels : {1, 2, 4}) {
            SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << ", " << channels << " channels");
            const Layers layers = random_layers(size, channels, channels == 4 ? 6 : 1, ++seed);
            const int bits = 24; // 129 x 75 texels reach 2^37: the table wraps around, and so do its largest windows
            const Layers counts = quantised(layers, bits);
            const auto cases = random_windows(size, int(layers.size()), 300, ++seed);
            const auto results = integer_sums(layers, cases, bits);
            for (size_t i = 0; i < cases.size(); ++i)
                for (int k = 0; k < channels; ++k) {
                    const base::Picture& p = counts[size_t(cases[i].layer)];
                    ASSERT_EQ(results[i].sum[k], uint32_t(brute_force_sum(p, k, cases[i]))) << i << ", channel " << k;
                }
        }
}

TEST_F(SummedAreaTable, IntegerMeansAreThoseOfBruteForce)
{
    uint32_t seed = 40;
    for (const base::Size size : window_sizes) {
        SCOPED_TRACE(testing::Message() << size.width << " x " << size.height);
        const int bits = parts::integer_sum_bits(double(size.area()));
        const Layers layers = random_layers(size, 2, 2, ++seed), counts = quantised(layers, bits);
        const auto cases = random_windows(size, 2, 300, ++seed);
        const auto results = integer_sums(layers, cases, bits);
        for (size_t i = 0; i < cases.size(); ++i)
            for (int k = 0; k < 2; ++k) {
                const auto mean = [&](const Layers& l) { return window_mean(l[size_t(cases[i].layer)], k, cases[i].lo, cases[i].hi); };
                ASSERT_NEAR(double(results[i].mean[k]), mean(counts) * double(parts::integer_sum_step(bits)), 4e-6) << i;
                ASSERT_NEAR(double(results[i].mean[k]), mean(layers), 4e-6 + 0.5 * double(parts::integer_sum_step(bits))) << i;
            }
    }
}

TEST_F(SummedAreaTable, IntegerMeansBearWrapAround)
{
    // Entries pass 2^32 a hundred times; windows of up to 256 texels do not.
    const base::Size size{129, 75};
    const Layers layers = random_layers(size, 2, 2, 60);
    std::mt19937 random(61);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<shaders::WindowCase> cases;
    for (int i = 0; i < 1000; ++i) {
        const vec2 lo = vec2(unit(random), unit(random)) * vec2(size.width, size.height) - 4.0f;
        cases.push_back({i % 2, lo, lo + 15.0f * vec2(unit(random), unit(random))});
    }
    const auto results = integer_sums(layers, cases, 24);
    for (size_t i = 0; i < cases.size(); ++i)
        for (int k = 0; k < 2; ++k)
            ASSERT_NEAR(double(results[i].mean[k]), window_mean(layers[size_t(cases[i].layer)], k, cases[i].lo, cases[i].hi), 4e-6) << i;
}

TEST_F(SummedAreaTable, IntegersClampTheirValues)
{
    Layers layers{base::Picture({4, 1}, 1)};
    layers[0].values = {-3.0f, 2.0f, 1.0f, 0.25f};
    const auto results = integer_sums(layers, {{0, {0, 0}, {1, 1}}, {0, {1, 0}, {2, 1}}, {0, {2, 0}, {3, 1}}, {0, {3, 0}, {4, 1}}}, 24);
    const uint32_t expected[] = {0, (1u << 24) - 1, (1u << 24) - 1, 1u << 22};
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(results[i].sum.x, expected[i]);
}

TEST_F(SummedAreaTable, DepthImagesAreSources)
{
    gpu::Image depth = image("depth", VK_FORMAT_D32_SFLOAT, {9, 5}, 2);
    gpu::PassList list(device());
    list.clear(list.import(depth), {{0.75f, 0, 0, 0}});
    const gpu::ImageId sums = parts::build_float_sums(list, list.import(depth), 1);
    const std::vector<shaders::WindowCase> cases = {{1, {0, 0}, {9, 5}}, {1, {1.5f, 2}, {3.25f, 2.5f}}};
    for (const vec4 mean : run_image_cases<vec4>(std::move(list), float_shader, cases, {{sums, gpu::Use::sample}}))
        EXPECT_EQ(mean.x, 0.75f);
}

TEST_F(SummedAreaTable, BitsAreThoseOfTheLargestWindow)
{
    EXPECT_EQ(parts::integer_sum_bits(1), 24);
    EXPECT_EQ(parts::integer_sum_bits(256), 24);
    EXPECT_EQ(parts::integer_sum_bits(257), 23);
    EXPECT_EQ(parts::integer_sum_bits(1024.0 * 1024), 12);
    EXPECT_EQ(parts::integer_sum_bits(1e12), 1);
    gpu::PassList list(device());
    gpu::Image source = image("source", VK_FORMAT_R32_SFLOAT, {4, 4});
    EXPECT_THROW(parts::build_integer_sums(list, list.import(source), 1, 25), base::Error);
    EXPECT_THROW(parts::build_integer_sums(list, list.import(source), 1, 0), base::Error);
    EXPECT_THROW(parts::build_float_sums(list, list.import(source), 3), base::Error);
}

} // namespace
} // namespace gnomon
