// SPDX-License-Identifier: Apache-2.0
#include "techniques/light_sampling/light_points.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::techniques::light_sampling {

namespace {

/// i's digits in `base`, mirrored at the point.
float radical_inverse(uint32_t i, uint32_t base)
{
    double value = 0.0, digit = 1.0 / double(base);
    for (; i > 0; i /= base, digit /= double(base)) value += digit * double(i % base);
    return float(value);
}

/// Hammersley's points (1960), halfway between those that touch 0.
std::vector<vec3> hammersley(int n)
{
    std::vector<vec3> out;
    for (int i = 0; i < n; ++i)
        out.emplace_back((float(i) + 0.5f) / float(n), radical_inverse(uint32_t(i), 2) + 0.5f / float(n), radical_inverse(uint32_t(i), 3));
    return out;
}

/// One point in each of n cells of equal area. A row has as many cells as the number leaves to it, and is as high as that makes it.
std::vector<vec3> jittered(int n)
{
    std::mt19937 random(1); // std::uniform_real_distribution may differ between libraries; mt19937 may not
    const auto unit = [&] { return float(random() >> 8) / 16777216.0f; };
    constexpr float golden = 0.61803399f;
    std::vector<vec3> out;
    const int rows = std::max(1, int(std::lround(std::sqrt(double(n)))));
    for (int r = 0; r < rows; ++r) {
        const int begin = n * r / rows, end = n * (r + 1) / rows;
        for (int i = begin; i < end; ++i) {
            const float x = (float(i - begin) + unit()) / float(end - begin);
            const float y = (float(begin) + float(end - begin) * unit()) / float(n);
            const float z = std::fmod(golden * float(i), 1.0f);
            out.emplace_back(x, y, z);
        }
    }
    return out;
}

/// A sphere looks the same from everywhere: a disk of even brightness. So must its points, in parallel projection. Those of the 3-sphere
/// in four dimensions do: evenly spread over it, they fall evenly onto the disk in every plane, as those of the 2-sphere fall evenly
/// onto every axis (Archimedes). Their shadow in three dimensions is the ball with density 1 / sqrt(1 - R^2), here from a point
/// of the disk across `axis` and an angle in the other two dimensions.
vec3 ball_point(vec3 u, const mat3& basis)
{
    const vec2 d = scene::square_to_disk(vec2(u));
    return basis * vec3(d, std::sqrt(std::max(0.0f, 1.0f - glm::dot(d, d))) * std::cos(2.0f * pi * u.z));
}

/// Relative to the mean over the points, not over the area, so that a point that sees all of them has 1. Where none of them lies on a texel
/// that emits in a channel, they count alike there.
void normalise(std::vector<vec4>& weights)
{
    glm::dvec4 sum(0.0);
    for (const vec4 w : weights) sum += glm::dvec4(w);
    for (vec4& w : weights)
        for (int c = 0; c < 4; ++c) w[c] = sum[c] > 0.0 ? float(double(w[c]) * double(weights.size()) / sum[c]) : 1.0f;
}

} // namespace

LightPoints light_points(const scene::Light& light, int n, Pattern pattern, vec3 seen_from)
{
    if (n == 1 || !light.soft()) return {{scene::light_point(light, seen_from, vec2(0.5f))}, {vec4(1)}};
    const auto* point = std::get_if<scene::PointLight>(&light.shape);
    const auto* spot = std::get_if<scene::SpotLight>(&light.shape);
    const vec3 centre = point ? point->position : spot ? spot->position : vec3(0);
    const float radius = point ? point->radius : spot ? spot->radius : 0.0f;
    const vec3 towards = seen_from - centre;
    const mat3 basis = scene::basis_about(glm::length(towards) > 0.0f ? glm::normalize(towards) : vec3(0, 0, 1));
    LightPoints out;
    for (const vec3 u : pattern == Pattern::jittered ? jittered(n) : hammersley(n)) {
        const vec2 inside = glm::min(vec2(u), vec2(1.0f - 0x1p-24f));
        out.points.push_back(
            point || spot ? vec4(centre + radius * ball_point(u, basis), 1.0f) : scene::light_point(light, seen_from, inside));
        out.weights.push_back(light.textured() ? vec4(light.image.at(inside), 1.0f) : vec4(1.0f));
    }
    normalise(out.weights);
    return out;
}

} // namespace gnomon::techniques::light_sampling
