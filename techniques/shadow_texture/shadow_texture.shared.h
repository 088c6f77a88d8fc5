// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADOW_TEXTURE_SHARED_H
#define GNOMON_SHADOW_TEXTURE_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

#define RECEIVE_LARGE 0
#define RECEIVE_ALL 1

TECHNIQUE_BEGIN(shadow_texture)

struct Params {
    int texture_size DEFAULT(1024);
    float largest_caster DEFAULT(0.5f);
    int receivers DEFAULT(RECEIVE_LARGE);
    int blur DEFAULT(1);
    int cookie DEFAULT(0);
    float cookie_turn DEFAULT(0.0f);
};

struct CasterConstants {
    mat4 clip_from_world[LIGHT_MAP_MAX_LAYERS];
};

struct ResolveConstants {
    View view;
    Light light;
    LightMap map;
    Params params;
    mat3 cookie_axes; ///< of the light: right, up, along, in world space
    float cookie_scale; ///< of the cookie's half side at one metre
};

SHARED_END

#endif
