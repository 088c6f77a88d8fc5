// SPDX-License-Identifier: Apache-2.0
#include "metrics/flip_color.h"

#include <cmath>
#include <cstddef>

namespace gnomon::metrics {

namespace {

// sRGB primaries and D65, with rational entries that keep white exact.
constexpr double xyz_from_rgb[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382},
};

constexpr double white(int k) { return xyz_from_rgb[k][0] + xyz_from_rgb[k][1] + xyz_from_rgb[k][2]; }

using Triple = std::array<double, 3>;

/// XYZ over the white point's.
Triple relative_xyz(const Color& rgb)
{
    Triple r;
    for (int k = 0; k < 3; ++k)
        r[size_t(k)]
            = (xyz_from_rgb[k][0] * double(rgb[0]) + xyz_from_rgb[k][1] * double(rgb[1]) + xyz_from_rgb[k][2] * double(rgb[2])) / white(k);
    return r;
}

Color rgb_from_relative_xyz(const Triple& relative)
{
    // Cramer's rule: the inverse of the matrix above, so that there and back is the identity.
    const auto& m = xyz_from_rgb;
    Triple v;
    for (int k = 0; k < 3; ++k) v[size_t(k)] = relative[size_t(k)] * white(k);
    const auto minor = [&](int r, int c) {
        const int r0 = (r + 1) % 3, r1 = (r + 2) % 3, c0 = (c + 1) % 3, c1 = (c + 2) % 3;
        return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    };
    const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    Color rgb;
    for (int k = 0; k < 3; ++k) rgb[size_t(k)] = float((minor(0, k) * v[0] + minor(1, k) * v[1] + minor(2, k) * v[2]) / determinant);
    return rgb;
}

} // namespace

Color ycxcz(const Color& rgb)
{
    const auto [x, y, z] = relative_xyz(rgb);
    return {float(116 * y - 16), float(500 * (x - y)), float(200 * (y - z))};
}

Color rgb_from_ycxcz(const Color& c)
{
    const double y = (double(c[0]) + 16) / 116;
    return rgb_from_relative_xyz({double(c[1]) / 500 + y, y, y - double(c[2]) / 200});
}

Color hunt_lab(const Color& rgb)
{
    const auto f = [](double t) {
        constexpr double d = 6.0 / 29.0;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29.0;
    };
    const auto [x, y, z] = relative_xyz(rgb);
    const double l = 116 * f(y) - 16;
    return {float(l), float(0.01 * l * 500 * (f(x) - f(y))), float(0.01 * l * 200 * (f(y) - f(z)))};
}

double hyab(const Color& a, const Color& b) { return double(std::abs(a[0] - b[0])) + std::hypot(double(a[1] - b[1]), double(a[2] - b[2])); }

} // namespace gnomon::metrics
