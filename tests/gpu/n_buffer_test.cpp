// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "window_cases.h"

#include "base/error.h"
#include "shadow/parts/n_buffer.h"
#include "shadow/parts/pyramid.h"

namespace gnomon {
namespace {

using namespace tests;
namespace parts = shadow::parts;
using Build = parts::NBuffer (*)(gpu::PassList&, gpu::ImageId, uint32_t);

class NBuffer : public gpu::DeviceTest {
protected:
    static std::vector<vec2> windows(Build build, const Layers& layers, const std::vector<shaders::WindowCase>& cases, uint32_t levels)
    {
        gpu::Image source = upload_layers(device(), layers);
        gpu::PassList list(device());
        const parts::NBuffer b = build(list, list.import(source), levels);
        return run_image_cases<vec2>(std::move(list), "tests/gpu/n_buffer_window.comp", cases, {{b.image, gpu::Use::sample}}, b.constants);
    }
    static std::vector<vec2> y_map_windows(const Layers& layers, const std::vector<shaders::WindowCase>& cases, uint32_t coarseness)
    {
        gpu::Image source = upload_layers(device(), layers);
        gpu::PassList list(device());
        const parts::YMap y = parts::build_y_map(list, list.import(source), coarseness);
        return run_image_cases<vec2>(std::move(list), "tests/gpu/y_map_window.comp", cases,
            {{y.pyramid, gpu::Use::sample}, {y.coarse.image, gpu::Use::sample}}, y.coarse.constants);
    }
    static std::vector<vec2> pyramid_windows(const Layers& layers, const std::vector<shaders::WindowCase>& cases)
    {
        gpu::Image source = upload_layers(device(), layers);
        gpu::PassList list(device());
        const gpu::ImageId pyramid = parts::build_min_max_pyramid(list, list.import(source));
        return run_image_cases<vec2>(std::move(list), "tests/gpu/pyramid_window.comp", cases, {{pyramid, gpu::Use::sample}});
    }
    /// The buffer as an image that outlives its list.
    template <class Add> static std::pair<gpu::Image, shaders::NBuffer> kept(const Layers& layers, Add add)
    {
        gpu::Image source = upload_layers(device(), layers);
        gpu::PassList list(device());
        const parts::NBuffer b = add(list, list.import(source));
        gpu::Image copy = device().image(list.desc(b.image));
        list.copy(b.image, list.import(copy));
        device().submit(std::move(list));
        return {std::move(copy), b.constants};
    }
};

TEST_F(NBuffer, LevelsAreClippedWindows)
{
    uint32_t seed = 1;
    for (const base::Size size : {base::Size{16, 16}, {37, 23}, {5, 40}, {1, 1}})
        for (const bool centred : {false, true}) {
            SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << (centred ? ", centred" : ""));
            const Layers layers = random_layers(size, 1, 2, ++seed);
            auto [image, b] = kept(layers, [&](gpu::PassList& list, gpu::ImageId from) {
                return centred ? parts::build_multiscale_map(list, from) : parts::build_min_max_n_buffer(list, from);
            });
            ASSERT_EQ(b.levels, int(parts::n_buffer_levels(std::min(size.width, size.height))));
            for (int level = 0; level < b.levels; ++level)
                for (int layer = 0; layer < 2; ++layer) {
                    const base::Picture p = device().read_back(image, uint32_t(level * b.layers + layer));
                    const int back = centred ? (1 << level) / 2 : 0;
                    for (int y = 0; y < size.height; ++y)
                        for (int x = 0; x < size.width; ++x) {
                            const glm::dvec2 lo(x - back, y - back), hi = lo + double(1 << level);
                            ASSERT_EQ(vec2(p.at(x, y, 0), p.at(x, y, 1)), window_min_max(layers[size_t(layer)], lo, hi)) << level;
                        }
                }
        }
}

TEST_F(NBuffer, RectanglesAreExact)
{
    uint32_t seed = 20;
    for (const base::Size size : window_sizes)
        for (const Build build : {parts::build_min_max_n_buffer, parts::build_multiscale_map})
            for (const uint32_t levels : {~0u, 3u, 1u}) {
                SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << ", levels " << levels);
                const Layers layers = random_layers(size, 1, 6, ++seed);
                const auto cases = random_windows(size, 6, 500, ++seed);
                const auto results = windows(build, layers, cases, levels);
                for (size_t i = 0; i < cases.size(); ++i)
                    ASSERT_EQ(results[i], window_min_max(layers[size_t(cases[i].layer)], cases[i].lo, cases[i].hi)) << i;
            }
}

/// Ends rounded outwards to texels of level `coarseness`.
vec2 rounded_min_max(const base::Picture& p, const shaders::WindowCase& c, uint32_t coarseness)
{
    glm::dvec2 lo, hi;
    for (int k = 0; k < 2; ++k) {
        const int size = k ? p.size.height : p.size.width, last = std::max(size >> coarseness, 1) - 1;
        const Span s(c.lo[k], c.hi[k], size);
        lo[k] = std::min(s.first() >> coarseness, last) << coarseness;
        const int end = std::min(s.last() >> coarseness, last);
        hi[k] = end == last ? size : (end + 1) << coarseness;
    }
    return window_min_max(p, lo, hi);
}

TEST_F(NBuffer, YMapsLieBetweenTheExactWindowAndTheRoundedOne)
{
    uint32_t seed = 60;
    for (const base::Size size : window_sizes)
        for (const uint32_t coarseness : {0u, 1u, 2u, 3u}) {
            SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << ", coarseness " << coarseness);
            const Layers layers = random_layers(size, 1, 3, ++seed);
            const auto cases = random_windows(size, 3, 500, ++seed);
            const auto results = y_map_windows(layers, cases, coarseness);
            const uint32_t rounding = std::min(coarseness, parts::pyramid_levels(size) - 1);
            for (size_t i = 0; i < cases.size(); ++i) {
                const base::Picture& p = layers[size_t(cases[i].layer)];
                const vec2 exact = window_min_max(p, cases[i].lo, cases[i].hi), rounded = rounded_min_max(p, cases[i], rounding);
                ASSERT_LE(results[i].x, exact.x) << i;
                ASSERT_GE(results[i].y, exact.y) << i;
                ASSERT_GE(results[i].x, rounded.x) << i;
                ASSERT_LE(results[i].y, rounded.y) << i;
            }
        }
}

TEST_F(NBuffer, YMapsAreTighterThanPyramids)
{
    Layers layers{base::Picture({128, 128}, 1)}; // a slope, on which the error is how far a window reaches too far
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) layers[0].at(x, y) = float(x + 2 * y);
    std::vector<shaders::WindowCase> cases;
    for (const auto& c : random_windows({128, 128}, 1, 2000, 6))
        if (glm::all(glm::greaterThan(c.hi - c.lo, vec2(10.0f)))) cases.push_back(c);
    const auto pyramid = pyramid_windows(layers, cases), y_map = y_map_windows(layers, cases, 2);
    double over[2] = {};
    for (size_t i = 0; i < cases.size(); ++i) {
        const vec2 exact = window_min_max(layers[0], cases[i].lo, cases[i].hi);
        over[0] += double(exact.x - pyramid[i].x + pyramid[i].y - exact.y);
        over[1] += double(exact.x - y_map[i].x + y_map[i].y - exact.y);
    }
    EXPECT_GT(over[1], 0.0);
    EXPECT_LT(2.0 * over[1], over[0]);
}

TEST_F(NBuffer, MeanLevelsAreClippedWindows)
{
    uint32_t seed = 80;
    for (const base::Size size : {base::Size{16, 16}, {37, 23}, {1, 9}})
        for (const int channels : {1, 2, 4}) {
            SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << ", " << channels << " channels");
            const Layers layers = random_layers(size, channels, 2, ++seed);
            auto [image, b]
                = kept(layers, [&](gpu::PassList& list, gpu::ImageId from) { return parts::build_mean_n_buffer(list, from, channels); });
            for (int level = 0; level < b.levels; ++level) {
                const base::Picture p = device().read_back(image, uint32_t(level * b.layers + 1));
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        for (int c = 0; c < channels; ++c) {
                            const glm::dvec2 lo(x, y), hi = lo + double(1 << level);
                            ASSERT_NEAR(double(p.at(x, y, c)), window_mean(layers[1], c, lo, hi), 2e-6) << level;
                        }
            }
        }
}

TEST_F(NBuffer, MeansOfPowersOfTwoAreExactAnywhere)
{
    const base::Size size{61, 40};
    const Layers layers = random_layers(size, 2, 3, 90);
    std::mt19937 random(91);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<shaders::WindowCase> cases;
    for (int i = 0; i < 600; ++i) {
        // sides of 1 to 32, and between 8 and 16; some reach over the rim
        const float side = i % 7 == 6 ? 8.0f + 8.0f * unit(random) : float(1 << i % 6);
        const vec2 lo = vec2(unit(random), unit(random)) * (vec2(size.width, size.height) - 0.8f * side) - 0.1f * side;
        cases.push_back({i % 3, lo, lo + side});
    }
    gpu::Image source = upload_layers(device(), layers);
    gpu::PassList list(device());
    const parts::NBuffer b = parts::build_mean_n_buffer(list, list.import(source), 2);
    const auto results = run_image_cases<vec4>(
        std::move(list), "tests/gpu/n_buffer_mean.comp", cases, {{b.image, gpu::Use::sample, gpu::Sampler::linear_clamp}}, b.constants);
    for (size_t i = 0; i < cases.size(); ++i) {
        const base::Picture& p = layers[size_t(cases[i].layer)];
        const double side = double(cases[i].hi.x - cases[i].lo.x), fine = std::floor(std::log2(side) + 1e-5);
        const auto square = [&](int c, double width) {
            const glm::dvec2 middle = 0.5 * (glm::dvec2(cases[i].lo) + glm::dvec2(cases[i].hi));
            const glm::dvec2 lo = glm::clamp(middle - width / 2, glm::dvec2(0), glm::dvec2(size.width, size.height) - width);
            return window_mean(p, c, lo, lo + width);
        };
        for (int c = 0; c < 2; ++c) {
            const double a = square(c, std::exp2(fine)), f = std::max(std::log2(side) - fine, 0.0);
            const double expected = f < 1e-5 ? a : glm::mix(a, square(c, std::exp2(fine + 1)), f);
            ASSERT_NEAR(double(results[i][c]), expected, 5e-3)
                << i << ", side " << side; // samplers have 8 bits for the place between texels
        }
    }
}

TEST_F(NBuffer, OtherChannelCountsAreRefused)
{
    gpu::Image source = image("source", VK_FORMAT_R32_SFLOAT, {4, 4});
    gpu::PassList list(device());
    EXPECT_THROW(parts::build_mean_n_buffer(list, list.import(source), 3), base::Error);
}

} // namespace
} // namespace gnomon
