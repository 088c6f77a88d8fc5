// SPDX-License-Identifier: Apache-2.0
// Cases and results of the GLSL functions that have a C++ twin.
#ifndef GNOMON_TESTS_TWINS_SHARED_H
#define GNOMON_TESTS_TWINS_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

SHARED_BEGIN(shaders)

struct LightCase {
    Light light;
    vec3 p_world;
    vec2 u;
};

struct LightResult {
    vec4 point; ///< light_point
    vec4 towards; ///< to_light
    uint reaches; ///< light_reaches
};

struct MapCase {
    LightMap map;
    vec3 p_world;
};

struct MapResult {
    int layer; ///< select_layer
    float next; ///< select_layers
    vec2 uv; ///< project
    float z, depth;
    uint inside;
    float stored; ///< stored_from_depth of the depth
    float reference; ///< reference_depth of the depth
    float linear; ///< depth_from_stored of the stored depth
    vec2 texel; ///< project
};

struct SoftCase {
    LightMapLayer layer;
    Light light;
    vec3 p_world;
    vec3 n; ///< of the receiver's plane
    float z; ///< depth of the window
};

struct SoftResult {
    float horizon; ///< light_above_horizon
    vec2 size; ///< light_half_size
    vec2 window; ///< window_half_width between the receiver's depth and z
};

struct RandomResult {
    uvec3 hash;
    vec2 unit;
};

struct TransmittanceCase {
    uint material;
    vec4 base;
};

SHARED_END

#endif
