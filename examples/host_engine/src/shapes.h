// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math.h"

#include <cstdint>
#include <vector>

namespace host {

/// Triangles as they are modelled: right-handed, Y-up, metres, counter-clockwise from outside.
struct Shape {
    struct Vertex {
        Vec3 position, normal;
        float u, v;
    };
    std::vector<Vertex> vertices;
    std::vector<uint16_t> indices;
};

Shape ground(float half); ///< u and v in metres
Shape box(Vec3 half);
Shape torus(float radius, float thickness); ///< around y
Shape ball(float radius);

} // namespace host
