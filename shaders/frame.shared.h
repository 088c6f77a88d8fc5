// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADERS_FRAME_SHARED_H
#define GNOMON_SHADERS_FRAME_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

/// scene::View for shaders; see docs/conventions.md for the spaces.
struct View {
    mat4 clip_from_world;
    mat4 world_from_clip;
    vec3 eye;
    float near; ///< metres
    vec3 forward; ///< unit, world
    uint orthographic; ///< 0 or 1
    vec2 size; ///< pixels
    uint frame; ///< Frame::index
    float pixel_radius; ///< half a pixel's width at unit distance (perspective) or in metres (orthographic)
};

#define LIGHT_DIRECTIONAL 0
#define LIGHT_SPOT 1
#define LIGHT_POINT 2
#define LIGHT_RECT 3
#define LIGHT_DISK 4

/// scene::Light for shaders.
struct Light {
    vec3 position; ///< centre; directional: unused
    uint kind; ///< LIGHT_*
    vec3 direction; ///< in which it shines: axis or normal, unit
    float radius; ///< metres; directional: angular radius, radians
    vec3 half_u; ///< rect; disk: an orthonormal basis of its plane times radius
    float cos_inner; ///< spot
    vec3 half_v;
    float cos_outer; ///< spot
    vec3 radiance; ///< colour * intensity
    float padding;
};

SHARED_END

#endif
