// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_LIGHTING_SHARED_H
#define GNOMON_LIGHTING_SHARED_H
#include "shaders/frame.shared.h"

SHARED_BEGIN(shaders)

struct AmbientConstants {
    View view;
    vec3 sky; ///< radiance from straight above
    uint emits; ///< 0 or 1: the emissive image is there
    vec3 ground; ///< radiance from straight below
    float padding;
};

struct LightingConstants {
    View view;
    Light light;
    uint shadowed; ///< 0: the image is not read
    uint colored; ///< 1: the image has three channels
};

#define BLENDED_MAX_LIGHTS 8

struct BlendedConstants {
    View view;
    vec3 sky;
    uint light_count;
    vec3 ground;
    float padding;
    Light lights[BLENDED_MAX_LIGHTS];
};

SHARED_END

#endif
