// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/warp_parameter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow::parts {

namespace {

constexpr double uniform = std::numeric_limits<double>::infinity();
constexpr double half_turn = 3.14159265358979323846;

} // namespace

double optimal_near(double z0, double z1, double extent) { return z1 > z0 ? extent / (z1 - z0) * (z0 + std::sqrt(z0 * z1)) : uniform; }

double falloff(double gamma, double half_fov)
{
    gamma = std::clamp(gamma, 0.0, half_turn);
    gamma = std::min(gamma, half_turn - gamma);
    const double none = half_fov / 3.0, all = half_fov + 0.3 * (0.5 * half_turn - half_fov);
    constexpr double at_fov = -0.2;
    if (gamma <= none) return -1.0;
    if (gamma <= half_fov) return -1.0 + (1.0 + at_fov) * (gamma - none) / (half_fov - none);
    if (gamma >= all) return 0.0;
    return at_fov * (1.0 - std::sin(0.5 * half_turn * (gamma - half_fov) / (all - half_fov)));
}

double near_from_eta(double eta, double z0, double z1, double extent)
{
    if (eta <= -1.0 || !(z1 > z0)) return uniform;
    if (eta == 0.0) return optimal_near(z0, z1, extent);
    const double ratio = z1 / z0, root = std::sqrt(ratio);
    if (eta < 0.0) return extent * (1.0 + root - eta * (ratio - 1.0)) / ((ratio - 1.0) * (eta + 1.0));
    return extent / ((root - 1.0) * (eta * root + 1.0));
}

double pseudo_near(double z0, double z1, double extent, double from, double to)
{
    if (!(z1 > z0)) return uniform;
    const double d = std::max(from - z0, 0.0), depth = z1 - z0;
    if (3.0 * d >= 2.0 * depth) return uniform;
    const double nearest = std::max(from, z0), furthest = std::max(std::min(to, z1), nearest);
    return extent / depth * std::max(z0 + std::sqrt(nearest * furthest), d / (2.0 - 3.0 * d / depth));
}

double trapezoid_near(double focus, double extent, double share)
{
    // t(v) = (n + extent) v / ((n + v) extent), solved for n at t(focus) = share
    return focus < share * extent ? extent * focus * (1.0 - share) / (share * extent - focus) : uniform;
}

double warp_near(const WarpLine& line, double gamma, double half_fov)
{
    return std::max(near_from_eta(falloff(gamma, half_fov), line.z0, line.z1, line.extent),
        pseudo_near(line.z0, line.z1, line.extent, line.from, line.to));
}

} // namespace gnomon::shadow::parts
