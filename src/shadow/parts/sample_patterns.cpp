// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/sample_patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace gnomon::shadow::parts {

namespace {

/// std::uniform_real_distribution may differ between libraries; mt19937 may not.
float unit(std::mt19937& random) { return float(random() >> 8) / 16777216.0f; }

void sort_outermost_first(std::vector<vec2>& points)
{
    std::stable_sort(points.begin(), points.end(), [](vec2 a, vec2 b) { return glm::dot(a, a) > glm::dot(b, b); });
}

/// Crowding of each pixel: a Gaussian around every set pixel, on a torus. Ulichney's sigma is 1.5; at 1.9 the noise has less power
/// at low frequencies.
class Crowding {
public:
    explicit Crowding(int size)
        : size_(size)
        , set(size_t(size * size), false)
        , energy_(size_t(size * size), 0.0f)
    {
        for (int y = 0; y < width; ++y)
            for (int x = 0; x < width; ++x) {
                const float dx = float(x - width / 2), dy = float(y - width / 2);
                kernel_[size_t(y * width + x)] = std::exp(-(dx * dx + dy * dy) / (2 * 1.9f * 1.9f));
            }
    }

    void put(int pixel, bool on)
    {
        set[size_t(pixel)] = on;
        const int cx = pixel % size_ + size_ - width / 2, cy = pixel / size_ + size_ - width / 2;
        for (int y = 0; y < width; ++y)
            for (int x = 0; x < width; ++x)
                energy_[size_t((cy + y) % size_ * size_ + (cx + x) % size_)] += (on ? 1.0f : -1.0f) * kernel_[size_t(y * width + x)];
    }

    /// The set pixel in the tightest cluster, or the clear one in the largest void.
    int extreme(bool on) const
    {
        int best = -1;
        float value = std::numeric_limits<float>::infinity();
        for (size_t i = 0; i < set.size(); ++i) {
            if (set[i] != on) continue;
            const float v = on ? -energy_[i] : energy_[i];
            if (v < value) value = v, best = int(i);
        }
        return best;
    }

private:
    static constexpr int width = 17;
    int size_;
    std::array<float, size_t(width* width)> kernel_;

public:
    std::vector<bool> set;

private:
    std::vector<float> energy_;
};

} // namespace

std::vector<vec2> poisson_disk(int count)
{
    std::mt19937 random(1);
    std::vector<vec2> points;
    // Mitchell's best candidate. The rim acts as a mirror, 2 (1 - |p|) away: without it, points crowd along it.
    while (int(points.size()) < count) {
        vec2 best(0);
        float best_distance = -1;
        for (int i = 0; i < 64 * (int(points.size()) + 1); ++i) {
            const float radius = std::sqrt(unit(random)), angle = 2 * pi * unit(random);
            const vec2 p = radius * vec2(std::cos(angle), std::sin(angle));
            float nearest = 2 * (1 - radius);
            for (const vec2 q : points) nearest = std::min(nearest, glm::length(p - q));
            if (nearest > best_distance) best_distance = nearest, best = p;
        }
        points.push_back(best);
    }
    // the mirror keeps them too far inside: the mean squared radius of the disk's area is one half
    float square = 0;
    for (const vec2 p : points) square += glm::dot(p, p) / float(points.size());
    for (vec2& p : points) p *= std::sqrt(0.5f / square);
    sort_outermost_first(points);
    return points;
}

std::vector<vec2> vogel_disk(int count)
{
    std::vector<vec2> points;
    const float golden_angle = pi * (3 - std::sqrt(5.0f));
    for (int i = count - 1; i >= 0; --i) {
        const float angle = float(i) * golden_angle;
        points.push_back(std::sqrt((float(i) + 0.5f) / float(count)) * vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

vec2 disk_to_square(vec2 p)
{
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float r = std::copysign(glm::length(p), wide ? p.x : p.y);
    if (r == 0.0f) return vec2(0);
    const float along = 4.0f / pi * std::atan(wide ? p.y / p.x : p.x / p.y) * r;
    return wide ? vec2(r, along) : vec2(along, r);
}

std::vector<std::string> rotations() { return {"none", "blue_noise", "interleaved_gradient"}; }

std::vector<uint32_t> void_and_cluster(int size)
{
    const int count = size * size, ones = count / 10;
    std::mt19937 random(1);
    Crowding pattern(size);
    for (int i = 0; i < ones;) {
        const int pixel = int(random() % uint32_t(count));
        if (!pattern.set[size_t(pixel)]) pattern.put(pixel, true), ++i;
    }
    // from the tightest cluster into the largest void until that is the same place
    for (int moved = 0; moved < count; ++moved) {
        const int from = pattern.extreme(true);
        pattern.put(from, false);
        const int to = pattern.extreme(false);
        pattern.put(to, true);
        if (from == to) break;
    }
    std::vector<uint32_t> rank(size_t(count), 0);
    Crowding rest = pattern;
    for (int r = ones - 1; r >= 0; --r) {
        const int pixel = rest.extreme(true);
        rest.put(pixel, false);
        rank[size_t(pixel)] = uint32_t(r);
    }
    // Filling the largest void to the end serves as Ulichney's third phase too: on a torus, the clear pixel with the most clear
    // neighbours is the one with the fewest set ones.
    for (int r = ones; r < count; ++r) {
        const int pixel = pattern.extreme(false);
        pattern.put(pixel, true);
        rank[size_t(pixel)] = uint32_t(r);
    }
    return rank;
}

gpu::Image blue_noise(gpu::Device& device)
{
    constexpr int size = 64;
    std::vector<float> values;
    for (const uint32_t rank : void_and_cluster(size)) values.push_back((float(rank) + 0.5f) / float(size * size));
    gpu::Image image = device.image({VK_FORMAT_R32_SFLOAT, {size, size}, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "blue noise"});
    device.upload(image, std::as_bytes(std::span(values)));
    return image;
}

} // namespace gnomon::shadow::parts
