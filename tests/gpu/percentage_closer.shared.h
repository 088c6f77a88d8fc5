// SPDX-License-Identifier: Apache-2.0
// Cases of shaders/percentage_closer.glsl and shaders/receiver_plane.glsl.
#ifndef GNOMON_TESTS_PERCENTAGE_CLOSER_SHARED_H
#define GNOMON_TESTS_PERCENTAGE_CLOSER_SHARED_H
#include "shaders/light_map.shared.h"

#define CASE_SEPARABLE 0
#define CASE_TAP 1
#define CASE_HARDWARE_TAP 2
#define CASE_HARDWARE_BOX 3

SHARED_BEGIN(shaders)

struct FilterCase {
    int kind; ///< CASE_*
    vec2 at; ///< receiver, texels
    float z;
    vec2 slope;
    float cone;
    int n; ///< separable
    int gaussian;
    int reconstruct; ///< RECONSTRUCT_*; a tap: 1 = bilinear
    int adaptive;
    vec2 d; ///< tap
};

struct PlaneCase {
    LightMapLayer layer;
    float size;
    vec3 p_world;
    vec3 n; ///< coded as the G-buffer does, and decoded
    float radius;
    float limit;
};

struct PlaneResult {
    vec2 at;
    float z;
    vec2 slope;
    float cone;
};

SHARED_END

#endif
