// SPDX-License-Identifier: Apache-2.0
// parts/window against its definition, written as a loop over the window in double.
#include "device_fixture.h"

#include "shadow/parts/window.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace gnomon {
namespace {

constexpr double unit_roundoff = 0x1p-24; // of one float operation, relative
constexpr int widths[] = {1, 2, 3, 8, 31, 127};
constexpr base::Size sizes[] = {{1, 1}, {1, 9}, {40, 33}, {128, 65}};
constexpr uint32_t layer_count = 3;

struct Format {
    VkFormat format;
    const char* name;
    int channels;
    double steps; // 0: floats; else the number of steps between 0 and 1
};
constexpr Format r32f = {VK_FORMAT_R32_SFLOAT, "r32f", 1, 0}, rg32f = {VK_FORMAT_R32G32_SFLOAT, "rg32f", 2, 0},
                 rgba32f = {VK_FORMAT_R32G32B32A32_SFLOAT, "rgba32f", 4, 0}, rgba8 = {VK_FORMAT_R8G8B8A8_UNORM, "rgba8", 4, 255},
                 rg16 = {VK_FORMAT_R16G16_UNORM, "rg16", 2, 65535};

using Layers = std::vector<base::Picture>;
using Operation = gpu::ImageId (*)(gpu::PassList&, gpu::ImageId, int);

gpu::ImageId window_mean(gpu::PassList& passes, gpu::ImageId values, int width)
{
    return shadow::parts::window_mean(passes, values, width);
}
gpu::ImageId window_log_mean_exp(gpu::PassList& passes, gpu::ImageId logs, int width)
{
    return shadow::parts::window_log_mean_exp(passes, logs, width);
}
gpu::ImageId window_gaussian(gpu::PassList& passes, gpu::ImageId values, int width)
{
    return shadow::parts::window_gaussian(passes, values, width);
}

std::vector<std::byte> encoded(const base::Picture& p, const Format& format)
{
    const auto texels_as = [&](auto type) {
        std::vector<decltype(type)> texels;
        for (const float v : p.values)
            texels.push_back(decltype(type)(format.steps == 0 ? double(v) : std::round(double(v) * format.steps)));
        const auto bytes = std::as_bytes(std::span(texels));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    return format.steps == 255 ? texels_as(uint8_t()) : format.steps == 65535 ? texels_as(uint16_t()) : texels_as(float());
}

/// Numbers that the format holds exactly, so that only the window itself rounds.
Layers random_layers(const Format& format, base::Size size, float least, float greatest, std::mt19937& random)
{
    std::uniform_real_distribution<float> uniform(least, greatest);
    Layers layers(layer_count, base::Picture(size, format.channels));
    for (base::Picture& p : layers)
        for (float& v : p.values) {
            v = uniform(random);
            if (format.steps != 0) v = float(std::round(double(v) * format.steps) / format.steps);
        }
    return layers;
}

/// What a window holds, along both axes: texels that repeat at the rim, and their weights.
struct Tap {
    size_t at; // of the first channel
    double weight;
};
std::vector<Tap> taps(const base::Picture& p, int x, int y, const std::vector<double>& weights)
{
    const int n = int(weights.size());
    std::vector<Tap> out;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int from_x = std::clamp(x - n / 2 + i, 0, p.size.width - 1), from_y = std::clamp(y - n / 2 + j, 0, p.size.height - 1);
            out.push_back(
                {(size_t(from_y) * size_t(p.size.width) + size_t(from_x)) * size_t(p.channels), weights[size_t(i)] * weights[size_t(j)]});
        }
    return out;
}
std::vector<double> box(int n) { return std::vector<double>(size_t(n), 1.0 / n); }

/// A texel of the twin: channel c of the window's result.
using Twin = std::function<double(const base::Picture&, const std::vector<Tap>&, int channel)>;

double mean_of(const base::Picture& p, const std::vector<Tap>& window, int c)
{
    double sum = 0;
    for (const Tap& t : window) sum += t.weight * double(p.values[t.at + size_t(c)]);
    return sum;
}
double min_max_of(const base::Picture& p, const std::vector<Tap>& window, int c)
{
    double out = c == 0 ? 1e300 : -1e300;
    for (const Tap& t : window) {
        const double v = double(p.values[t.at + size_t(c)]);
        out = c == 0 ? std::min(out, v) : std::max(out, v);
    }
    return out;
}
double log_mean_exp_of(const base::Picture& p, const std::vector<Tap>& window, int c)
{
    double greatest = -1e300, sum = 0;
    for (const Tap& t : window) greatest = std::max(greatest, double(p.values[t.at + size_t(c)]));
    for (const Tap& t : window) sum += t.weight * std::exp(double(p.values[t.at + size_t(c)]) - greatest);
    return greatest + std::log(sum);
}

class Window : public gpu::DeviceTest {
protected:
    static Layers run(Operation operation, const Layers& in, const Format& format, int width)
    {
        gpu::Image from = image("values", format.format, in[0].size, uint32_t(in.size()));
        gpu::Image to = image("result", format.format, in[0].size, uint32_t(in.size()));
        for (uint32_t layer = 0; layer < in.size(); ++layer) device().upload(from, encoded(in[layer], format), layer);
        gpu::PassList list(device());
        list.copy(operation(list, list.import(from), width), list.import(to));
        device().submit(std::move(list));
        Layers out;
        for (uint32_t layer = 0; layer < in.size(); ++layer) out.push_back(device().read_back(to, layer));
        return out;
    }

    /// Compares every layer at its corners and at texels drawn by chance: the definition costs width^2 a texel.
    static void expect_like(const Twin& twin, const std::vector<double>& weights, const Layers& in, const Layers& out, double allowed)
    {
        std::mt19937 random(7);
        for (size_t layer = 0; layer < in.size(); ++layer) {
            const base::Picture& p = in[layer];
            std::vector<std::pair<int, int>> texels
                = {{0, 0}, {p.size.width - 1, 0}, {0, p.size.height - 1}, {p.size.width - 1, p.size.height - 1}};
            for (int i = 0; i < 60; ++i)
                texels.emplace_back(int(random() % uint32_t(p.size.width)), int(random() % uint32_t(p.size.height)));
            for (const auto& [x, y] : texels) {
                const std::vector<Tap> window = taps(p, x, y, weights);
                for (int c = 0; c < p.channels; ++c)
                    ASSERT_NEAR(double(out[layer].at(x, y, c)), twin(p, window, c), allowed)
                        << "texel " << x << ", " << y << ", layer " << layer << ", channel " << c;
            }
        }
    }

    template <class Test> static void for_sizes_and_widths(Test test)
    {
        for (const base::Size size : sizes)
            for (const int width : widths) {
                SCOPED_TRACE(std::to_string(size.width) + " x " + std::to_string(size.height) + ", width " + std::to_string(width));
                test(size, width);
            }
    }
};

TEST_F(Window, MeansAreThoseOfTheLoop)
{
    std::mt19937 random(1);
    for (const Format& format : {r32f, rg32f, rgba32f, rgba8, rg16}) {
        SCOPED_TRACE(format.name);
        for_sizes_and_widths([&](base::Size size, int width) {
            const Layers in = random_layers(format, size, format.steps == 0 ? -1.0f : 0.0f, 1.0f, random);
            // Floats: each axis rounds a sum of `width` terms of at most 1 after each addition, and the division.
            // Fixed point: each axis rounds to half a step, and the second one averages the first's errors.
            const double floats = 2 * (width + 1) * unit_roundoff;
            expect_like(
                mean_of, box(width), in, run(window_mean, in, format, width), format.steps == 0 ? floats : 1.0 / format.steps + floats);
        });
    }
}

TEST_F(Window, LeastAndGreatestAreExact)
{
    std::mt19937 random(2);
    for_sizes_and_widths([&](base::Size size, int width) {
        const Layers in = random_layers(rg32f, size, -1.0f, 1.0f, random);
        expect_like(min_max_of, box(width), in, run(shadow::parts::window_min_max, in, rg32f, width), 0.0);
    });
}

TEST_F(Window, MeansOfExponentialsComeFromTheirLogarithms)
{
    std::mt19937 random(3);
    // Far apart, the greatest value alone decides; close together, all do.
    for (const auto& [least, greatest] :
        {std::pair{-2000.0f, 2000.0f}, std::pair{1999.0f, 2000.0f}, std::pair{-2000.0f, -1999.0f}, std::pair{-3.0f, 3.0f}})
        for_sizes_and_widths([&, least = least, greatest = greatest](base::Size size, int width) {
            const Layers in = random_layers(r32f, size, least, greatest, random);
            // Each of an axis's `width` joins rounds a number as large as the greatest value, after a logarithm that drivers give to
            // about 2^-21; the roundings of both axes pass through unchanged.
            const double magnitude = std::max(std::abs(double(least)), std::abs(double(greatest))) + std::log(127.0 * 127.0);
            expect_like(log_mean_exp_of, box(width), in, run(window_log_mean_exp, in, r32f, width),
                2 * (width + 1) * (magnitude * unit_roundoff + 0x1p-21));
        });
}

TEST_F(Window, GaussiansAreThoseOfTheLoop)
{
    std::mt19937 random(4);
    for (const Format& format : {rg32f, rgba8})
        for_sizes_and_widths([&](base::Size size, int width) {
            const Layers in = random_layers(format, size, 0.0f, 1.0f, random);
            std::vector<double> weights;
            double sum = 0;
            for (int i = 0; i < width; ++i) {
                const double x = (i + 0.5 - 0.5 * width) / (width / 6.0); // in standard deviations from the window's centre
                weights.push_back(std::exp(-0.5 * x * x));
                sum += weights.back();
            }
            for (double& w : weights) w /= sum;
            // Products and sums round once each, and so did the weights.
            const double floats = 2 * (2 * width + 1) * unit_roundoff;
            expect_like(
                mean_of, weights, in, run(window_gaussian, in, format, width), format.steps == 0 ? floats : 1.0 / format.steps + floats);
        });
}

/// The reason for sums that never subtract: with a running sum, or one of a summed-area table, the windows behind a large value would
/// hold what was rounded away beside it, 5e27 instead of 2e-35.
TEST_F(Window, SmallExponentialsBesideLargeOnesKeepTheirPrecision)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(1.0f, 2.0f);
    Layers in(layer_count, base::Picture({128, 65}, 1));
    for (base::Picture& p : in)
        for (int y = 0; y < p.size.height; ++y)
            for (int x = 0; x < p.size.width; ++x) {
                const bool large = (x / 20 + y / 20) % 2 == 1;
                p.at(x, y) = uniform(random) * std::exp(large ? 80.0f : -80.0f);
            }
    for (const int width : {2, 3, 8, 31}) {
        const Layers out = run(window_mean, in, r32f, width);
        size_t small = 0;
        for (size_t layer = 0; layer < in.size(); ++layer)
            for (int y = 0; y < 65; ++y)
                for (int x = 0; x < 128; ++x) {
                    const double expected = mean_of(in[layer], taps(in[layer], x, y, box(width)), 0);
                    ASSERT_NEAR(double(out[layer].at(x, y)) / expected, 1.0, 2 * (width + 1) * unit_roundoff)
                        << "width " << width << ", texel " << x << ", " << y << ", layer " << layer;
                    small += expected < 1e-30;
                }
        EXPECT_EQ(small > 100, width < 20) << "windows without a large value, width " << width;
    }
}

} // namespace
} // namespace gnomon
