// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <functional>
#include <numbers>

namespace host {

namespace {

/// A grid of (columns + 1) x (rows + 1) vertices over the unit square, whose outside is where u x v points.
Shape sheet(int columns, int rows, const std::function<Shape::Vertex(float u, float v)>& at)
{
    Shape shape;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            shape.vertices.push_back(at(float(column) / float(columns), float(row) / float(rows)));
    const auto index = [&](int column, int row) { return uint16_t(row * (columns + 1) + column); };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const uint16_t a = index(column, row), b = index(column + 1, row), c = index(column + 1, row + 1), d = index(column, row + 1);
            for (uint16_t i : {a, b, c, a, c, d}) shape.indices.push_back(i);
        }
    return shape;
}

} // namespace

Shape ground(float half)
{
    return sheet(1, 1, [half](float u, float v) {
        const float x = (2 * u - 1) * half, z = (1 - 2 * v) * half;
        return Shape::Vertex{{x, 0, z}, {0, 1, 0}, x, z};
    });
}

Shape box(Vec3 half)
{
    Shape shape;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            const Vec3 ends[] = {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}};
            const Vec3 normal = normalize(ends[axis]) * side, along = ends[axis] * side;
            const Vec3 right = ends[(axis + 1) % 3] * side, up = ends[(axis + 2) % 3];
            const Shape face = sheet(1, 1, [&](float u, float v) {
                return Shape::Vertex{along + right * (2 * u - 1) + up * (2 * v - 1), normal, u, v};
            });
            const uint16_t first = uint16_t(shape.vertices.size());
            shape.vertices.insert(shape.vertices.end(), face.vertices.begin(), face.vertices.end());
            for (uint16_t i : face.indices) shape.indices.push_back(uint16_t(first + i));
        }
    return shape;
}

Shape torus(float radius, float thickness)
{
    return sheet(48, 20, [=](float u, float v) {
        const float around = u * 2 * std::numbers::pi_v<float>, across = v * 2 * std::numbers::pi_v<float>;
        const Vec3 outwards{std::sin(around), 0, std::cos(around)};
        const Vec3 normal = outwards * std::cos(across) + Vec3{0, std::sin(across), 0};
        return Shape::Vertex{outwards * radius + normal * thickness, normal, u * 8, v};
    });
}

Shape ball(float radius)
{
    return sheet(32, 16, [=](float u, float v) {
        const float around = u * 2 * std::numbers::pi_v<float>, height = (v - 0.5f) * std::numbers::pi_v<float>;
        const Vec3 normal{std::cos(height) * std::sin(around), std::sin(height), std::cos(height) * std::cos(around)};
        return Shape::Vertex{normal * radius, normal, u * 4, v};
    });
}

} // namespace host
