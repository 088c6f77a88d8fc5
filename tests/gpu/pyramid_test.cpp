// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "window_cases.h"

#include "shadow/parts/pyramid.h"

namespace gnomon {
namespace {

using namespace tests;
namespace parts = shadow::parts;

class Pyramid : public gpu::DeviceTest { };

/// Texel i of the next level covers [i n / m, (i + 1) n / m) of this one's n texels.
base::Picture next_mean_level(const base::Picture& above)
{
    const base::Size size{std::max(above.size.width / 2, 1), std::max(above.size.height / 2, 1)};
    const glm::dvec2 step(double(above.size.width) / size.width, double(above.size.height) / size.height);
    base::Picture level(size, above.channels);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < above.channels; ++c)
                level.at(x, y, c) = float(window_mean(above, c, step * glm::dvec2(x, y), step * glm::dvec2(x + 1, y + 1)));
    return level;
}

TEST_F(Pyramid, MeansAreThoseOfEvenShares)
{
    uint32_t seed = 1;
    for (const base::Size size : window_sizes)
        for (const int channels : {1, 2, 4}) {
            SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << ", " << channels << " channels");
            const Layers layers = random_layers(size, channels, channels == 2 ? 6 : 1, ++seed);
            gpu::Image source = upload_layers(device(), layers);
            const uint32_t levels = parts::pyramid_levels(size);
            gpu::Image chain = image("chain", source.desc().format, size, uint32_t(layers.size()), levels);
            for (uint32_t i = 0; i < layers.size(); ++i) device().upload(chain, std::as_bytes(std::span(layers[i].values)), i);
            gpu::PassList list(device());
            parts::fill_mean_pyramid(list, list.import(chain));
            device().submit(std::move(list));
            for (uint32_t i = 0; i < layers.size(); ++i) {
                base::Picture expected = layers[i];
                for (uint32_t mip = 1; mip < levels; ++mip) {
                    expected = next_mean_level(expected);
                    const base::Picture level = device().read_back(chain, i, mip);
                    ASSERT_EQ(level.size, expected.size);
                    for (size_t k = 0; k < level.values.size(); ++k) ASSERT_NEAR(level.values[k], expected.values[k], 1e-6f) << mip;
                }
                const glm::dvec2 extent(size.width, size.height);
                for (int c = 0; c < channels; ++c)
                    ASSERT_NEAR(double(expected.at(0, 0, c)), window_mean(layers[i], c, {0, 0}, extent), 1e-6);
            }
        }
}

TEST_F(Pyramid, MinMaxLevelsAreThoseOfBruteForce)
{
    uint32_t seed = 50;
    for (const base::Size size : window_sizes) {
        SCOPED_TRACE(testing::Message() << size.width << " x " << size.height);
        const Layers layers = random_layers(size, 1, 3, ++seed);
        gpu::Image source = upload_layers(device(), layers);
        const uint32_t levels = parts::pyramid_levels(size);
        gpu::Image copy = image("pyramid", VK_FORMAT_R32G32_SFLOAT, size, 3, levels);
        gpu::PassList list(device());
        list.copy(parts::build_min_max_pyramid(list, list.import(source)), list.import(copy));
        device().submit(std::move(list));
        for (uint32_t mip = 0; mip < levels; ++mip) {
            const base::Picture level = device().read_back(copy, 2, mip);
            for (int y = 0; y < level.size.height; ++y)
                for (int x = 0; x < level.size.width; ++x) {
                    const glm::dvec2 lo(x << mip, y << mip);
                    const glm::dvec2 hi(
                        x + 1 == level.size.width ? size.width : (x + 1) << mip, y + 1 == level.size.height ? size.height : (y + 1) << mip);
                    ASSERT_EQ(vec2(level.at(x, y, 0), level.at(x, y, 1)), window_min_max(layers[2], lo, hi)) << mip;
                }
        }
    }
}

/// What 2 x 2 texels of one level cover: the window's ends rounded outwards, at the finest level where two texels hold it.
std::pair<glm::dvec2, glm::dvec2> covered(const shaders::WindowCase& c, base::Size size)
{
    const Span spans[] = {{c.lo.x, c.hi.x, size.width}, {c.lo.y, c.hi.y, size.height}};
    const int most = int(parts::pyramid_levels(size)) - 1;
    for (int level = 0;; ++level) {
        const bool held = std::ranges::all_of(spans, [&](const Span& s) { return (s.last() >> level) - (s.first() >> level) <= 1; });
        if (!held && level < most) continue;
        glm::dvec2 lo, hi;
        for (int k = 0; k < 2; ++k) {
            const int texels = k ? size.height : size.width, last = std::max(texels >> level, 1) - 1;
            lo[k] = std::min(spans[k].first() >> level, last) << level;
            const int end = std::min(spans[k].last() >> level, last);
            hi[k] = end == last ? texels : (end + 1) << level;
        }
        return {lo, hi};
    }
}

TEST_F(Pyramid, WindowsAreHeldByFourTexels)
{
    uint32_t seed = 90;
    for (const base::Size size : window_sizes) {
        SCOPED_TRACE(testing::Message() << size.width << " x " << size.height);
        const Layers layers = random_layers(size, 1, 6, ++seed);
        const auto cases = random_windows(size, 6, 1000, ++seed);
        gpu::Image source = upload_layers(device(), layers);
        gpu::PassList list(device());
        const gpu::ImageId pyramid = parts::build_min_max_pyramid(list, list.import(source));
        const auto results = run_image_cases<vec2>(std::move(list), "tests/gpu/pyramid_window.comp", cases, {{pyramid, gpu::Use::sample}});
        for (size_t i = 0; i < cases.size(); ++i) {
            const base::Picture& p = layers[size_t(cases[i].layer)];
            const vec2 exact = window_min_max(p, cases[i].lo, cases[i].hi);
            ASSERT_LE(results[i].x, exact.x) << i;
            ASSERT_GE(results[i].y, exact.y) << i;
            const auto [lo, hi] = covered(cases[i], size);
            ASSERT_EQ(results[i], window_min_max(p, lo, hi)) << i;
        }
    }
}

TEST_F(Pyramid, DepthImagesAreSources)
{
    gpu::Image depth = image("depth", VK_FORMAT_D16_UNORM, {17, 3}, 2);
    gpu::PassList list(device());
    list.clear(list.import(depth), {{1.0f, 0, 0, 0}});
    const gpu::ImageId pyramid = parts::build_min_max_pyramid(list, list.import(depth));
    const std::vector<shaders::WindowCase> cases = {{1, {0, 0}, {17, 3}}};
    const auto results = run_image_cases<vec2>(std::move(list), "tests/gpu/pyramid_window.comp", cases, {{pyramid, gpu::Use::sample}});
    EXPECT_EQ(results[0], vec2(1));
}

TEST_F(Pyramid, LevelsEndAtOneTexel)
{
    EXPECT_EQ(parts::pyramid_levels({1, 1}), 1u);
    EXPECT_EQ(parts::pyramid_levels({2, 1}), 2u);
    EXPECT_EQ(parts::pyramid_levels({129, 75}), 8u);
}

} // namespace
} // namespace gnomon
