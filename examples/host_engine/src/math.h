// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

// As much of vectors and matrices as this renderer needs. Matrices are stored by column and act on column vectors.
namespace host {

struct Vec3 {
    float x = 0, y = 0, z = 0;
};
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Vec3 normalize(Vec3 a) { return a * (1.0f / std::sqrt(dot(a, a))); }

using Mat3 = std::array<Vec3, 3>; // columns
inline Vec3 operator*(const Mat3& m, Vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
inline Mat3 operator*(const Mat3& a, const Mat3& b) { return {a * b[0], a * b[1], a * b[2]}; }
inline Mat3 transposed(const Mat3& m) { return {Vec3{m[0].x, m[1].x, m[2].x}, Vec3{m[0].y, m[1].y, m[2].y}, Vec3{m[0].z, m[1].z, m[2].z}}; }
/// Right-handed, about a unit axis.
inline Mat3 rotation(Vec3 axis, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](Vec3 v) { return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c)); };
    return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

using Mat4 = std::array<float, 16>;
inline Mat4 operator*(const Mat4& a, const Mat4& b)
{
    Mat4 out{};
    for (size_t column = 0; column < 4; ++column)
        for (size_t row = 0; row < 4; ++row)
            for (size_t k = 0; k < 4; ++k) out[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
    return out;
}

} // namespace host
