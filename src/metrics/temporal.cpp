// SPDX-License-Identifier: Apache-2.0
#include "metrics/temporal.h"

#include "base/error.h"
#include "metrics/comparison.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::metrics {

namespace {

/// FLIP's filter for lightness at 67 pixels a degree is 1.03 pixels wide; at less the pixel grid shows through (measured: docs/results.md).
constexpr float sigma = 1.5f;
constexpr int reach = 4; ///< pixels, from the one in which a point falls; the Gaussian is then below 2 %

using Vec = std::array<float, 3>;

Vec vector_at(const base::Picture& p, size_t i) { return {p.values[3 * i], p.values[3 * i + 1], p.values[3 * i + 2]}; }
float dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// A point of a surface.
struct Point {
    Vec position, normal;
    float width; ///< of a pixel there
};

/// What is seen at a point: means of the error and of the test alone, and the variance of the error's.
struct Seen {
    double error = 0, test = 0, variance = 0;
};
enum class Found { here, lost, moved };

/// One frame, ready to be looked up.
class Layer {
public:
    Layer(const SequenceFrame& frame, bool fixed)
        : frame_(frame)
        , size_(frame.shown.truth.size)
        , fixed_(fixed)
        , errors_(size_.area(), 0.0f)
        , tests_(size_.area(), 0.0f)
        , variances_(size_.area(), 0.0f)
        , sums_(size_t(size_.width + 1) * size_t(size_.height + 1), 0)
    {
        const Grey grey(frame.shown);
        const size_t width = size_t(size_.width), row = width + 1;
        for (size_t i = 0; i < errors_.size(); ++i) {
            tests_[i] = grey.test(i);
            if (grey.scored(i)) errors_[i] = grey.difference(i), variances_[i] = grey.variance(i);
            const bool step = (i % width > 0 && tests_[i] != tests_[i - 1]) || (i >= width && tests_[i] != tests_[i - width]);
            const size_t at = (i / width + 1) * row + i % width + 1;
            sums_[at] = sums_[at - 1] + sums_[at - row] - sums_[at - row - 1] + (errors_[i] != 0.0f || variances_[i] != 0.0f || step);
        }
    }

    bool scored(size_t pixel) const { return frame_.shown.mask[pixel] != 0; }
    Point point(size_t i) const { return {vector_at(frame_.position, i), vector_at(frame_.normal, i), frame_.pixel_width.values[i]}; }

    Found find(const Point& point, Seen& seen) const
    {
        const auto [px, py] = frame_.pixel_of(point.position);
        if (!(px >= 0 && py >= 0 && px < float(size_.width) && py < float(size_.height))) return Found::lost;
        const int x = int(px), y = int(py);
        // a kernel cut off by the picture's edge would see another part of the error as the view moves
        if (!fixed_ && (x < reach || y < reach || x + reach >= size_.width || y + reach >= size_.height)) return Found::lost;
        const size_t nearest = index(x, y);
        if (fixed_ && distance(point, nearest) > 0.01f * point.width) return Found::moved;
        if (!scored(nearest) || !same_surface(point, nearest)) return Found::lost;
        seen = around(point, px, py);
        return Found::here;
    }

private:
    size_t index(int x, int y) const { return size_t(y) * size_t(size_.width) + size_t(x); }

    float distance(const Point& point, size_t pixel) const
    {
        const Vec way = minus(vector_at(frame_.position, pixel), point.position);
        return std::sqrt(dot(way, way));
    }

    /// In one plane to within a pixel, and not bent by more than 37 degrees.
    bool same_surface(const Point& point, size_t pixel) const
    {
        return std::abs(dot(point.normal, minus(vector_at(frame_.position, pixel), point.position))) <= point.width
            && dot(point.normal, vector_at(frame_.normal, pixel)) >= 0.8f;
    }

    Seen around(const Point& point, float px, float py) const
    {
        const int left = std::max(int(px) - reach, 0), right = std::min(int(px) + reach, size_.width - 1);
        const int top = std::max(int(py) - reach, 0), bottom = std::min(int(py) + reach, size_.height - 1);
        const auto sum = [&](int x, int y) { return sums_[size_t(y) * (size_t(size_.width) + 1) + size_t(x)]; };
        if (sum(right + 1, bottom + 1) - sum(left, bottom + 1) - sum(right + 1, top) + sum(left, top) == 0)
            return {0, double(tests_[index(int(px), int(py))]), 0};
        const auto weight = [](float d) { return std::exp(-d * d / (2 * sigma * sigma)); };
        std::array<float, 2 * reach + 1> across{};
        for (int x = left; x <= right; ++x) across[size_t(x - left)] = weight(float(x) + 0.5f - px);
        double total = 0, error = 0, test = 0, variance = 0;
        for (int y = top; y <= bottom; ++y) {
            const float down = weight(float(y) + 0.5f - py);
            for (int x = left; x <= right; ++x) {
                const size_t i = index(x, y);
                if (!scored(i) || !same_surface(point, i)) continue;
                const double w = double(down * across[size_t(x - left)]);
                total += w, error += w * double(errors_[i]), test += w * double(tests_[i]), variance += w * w * double(variances_[i]);
            }
        }
        return {error / total, test / total, variance / (total * total)};
    }

    const SequenceFrame& frame_;
    const base::Size size_;
    const bool fixed_;
    std::vector<float> errors_, tests_, variances_;
    std::vector<uint32_t> sums_; ///< of the pixels above and left of each corner, those that are not as quiet as the rest: wrong, noisy, or
                                 ///< unlike a neighbour
};

struct Mean {
    double sum = 0;
    size_t count = 0;
    void add(double v) { sum += v, ++count; }
    double value() const { return count ? sum / double(count) : 0.0; }
};

double change_by_noise(const Seen& a, const Seen& b) { return std::sqrt(2.0 / std::numbers::pi * (a.variance + b.variance)); }

class Follower {
public:
    Follower(const std::vector<SequenceFrame>& frames, bool fixed)
        : size_(frames.front().shown.truth.size)
        , fixed_(fixed)
        , changes_(frames.size() - 1)
        , counts_(size_.area(), 0)
    {
        for (const SequenceFrame& frame : frames) layers_.emplace_back(frame, fixed);
        out_.map = base::Picture(size_, 1);
    }

    Temporal run()
    {
        for (size_t t = 0; t < layers_.size(); ++t)
            for (size_t i = 0; i < size_.area(); ++i)
                if (layers_[t].scored(i)) follow(t, i);
        out_.flicker = flicker_.value(), out_.swimming = swimming_.value(), out_.noise = noise_.value();
        for (const Mean& m : changes_) out_.change.push_back(m.value());
        std::vector<double> sorted = out_.change;
        std::sort(sorted.begin(), sorted.end());
        const size_t n = sorted.size();
        out_.popping = sorted.back() - 0.5 * (sorted[n / 2] + sorted[(n - 1) / 2]);
        for (size_t i = 0; i < counts_.size(); ++i)
            if (counts_[i]) out_.map.values[i] /= float(counts_[i]);
        return std::move(out_);
    }

private:
    void follow(size_t t, size_t pixel)
    {
        const Point point = layers_[t].point(pixel);
        Seen now, before, after;
        if (layers_[t].find(point, now) != Found::here) return count(Found::lost);
        const Found earlier = t > 0 ? layers_[t - 1].find(point, before) : Found::lost;
        if (earlier == Found::here) {
            changes_[t - 1].add(std::abs(change(before, now)));
            noise_.add(change_by_noise(now, before));
        }
        if (t == 0 || t + 1 == layers_.size()) return;
        if (earlier != Found::here) return count(earlier);
        const Found later = layers_[t + 1].find(point, after);
        count(later);
        if (later != Found::here) return;
        const double d1 = change(before, now), d2 = change(now, after);
        flicker_.add(d1 * d2 < 0 ? std::min(std::abs(d1), std::abs(d2)) : 0.0);
        swimming_.add(0.5 * std::abs(d1 + d2));
        out_.map.values[pixel] += float(0.5 * (std::abs(d1) + std::abs(d2))), ++counts_[pixel];
    }

    /// Where nothing but the camera moves, the truth at a point of a surface stays, so that the change of the test alone is that of the
    /// error. Each holds what the pixel grid makes of edges, the one of the test's, the other of those in which test and truth differ: a
    /// filtered edge against a sharp one, or a sharp one against the same. What is real is in both.
    double change(const Seen& before, const Seen& now) const
    {
        const double error = now.error - before.error, test = now.test - before.test;
        return fixed_ || std::abs(error) < std::abs(test) ? error : test;
    }

    void count(Found found) { ++(found == Found::here ? out_.followed : found == Found::lost ? out_.lost : out_.moved); }

    base::Size size_;
    bool fixed_;
    std::vector<Layer> layers_;
    std::vector<Mean> changes_;
    std::vector<uint32_t> counts_;
    Mean flicker_, swimming_, noise_;
    Temporal out_;
};

} // namespace

Temporal measure_sequence(const std::vector<SequenceFrame>& frames, bool fixed)
{
    if (frames.size() < 3) base::fail("a sequence of {} frames is too short to follow anything; three are the least", frames.size());
    const base::Size size = frames.front().shown.truth.size;
    for (const SequenceFrame& f : frames)
        if (f.shown.truth.size != size || f.position.values.size() != size.area() * 3 || f.normal.values.size() != size.area() * 3
            || f.pixel_width.values.size() != size.area())
            base::fail("the frames of a sequence are not all {}x{} pixels; render them at one size", size.width, size.height);
    return Follower(frames, fixed).run();
}

const std::vector<Metric>& temporal_metrics()
{
    static const std::vector<Metric> all{
        {"flicker", "visibility", "mean change of the error, along the surfaces, that the next frame takes back", true, true, nullptr},
        {"swimming", "visibility", "mean change of the error from frame to frame, along the surfaces, that lasts", true, true, nullptr},
        {"popping", "visibility", "mean change in the worst frame beyond that in the median one", true, true, nullptr},
        {"temporal_noise", "visibility", "what the truth's noise adds to the mean change: smaller differences say nothing", false, true,
            nullptr},
    };
    return all;
}

} // namespace gnomon::metrics
