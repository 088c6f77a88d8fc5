// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_PLANAR_SHARED_H
#define GNOMON_PLANAR_SHARED_H
#include "shaders/frame.shared.h"

#define PLANAR_MAX_PLANES 8
#define PLANAR_NONE 255u

TECHNIQUE_BEGIN(planar)

struct Params {
    int planes DEFAULT(8);
    float smallest DEFAULT(0.01f);
    float darkness DEFAULT(1.0f);
    int once DEFAULT(1);
};

struct ReceiverConstants {
    View view;
    Light light;
    vec4 planes[PLANAR_MAX_PLANES]; ///< positive on the light's side
    uint plane_count;
    uint edge_on; ///< bit k: plane k holds the light
    float thickness; ///< metres
    float padding;
};

struct TagConstants {
    uint plane;
};

struct CasterConstants {
    mat4 clip_from_caster; ///< projects from the light onto the plane, then into the picture
    vec4 above; ///< a caster's height above the plane, less the plane's thickness
    vec4 before; ///< positive on the plane's side of the light
    float kept; ///< of the light
};

SHARED_END

#endif
