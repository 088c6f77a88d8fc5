// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VOLUME_OUTLINES_SHARED_H
#define GNOMON_VOLUME_OUTLINES_SHARED_H
#include "shaders/frame.shared.h"

SHARED_BEGIN(shaders)

struct VolumeOutlines {
    View view;
    Light light;
    float reach; ///< metres along the light's rays
    float half_width; ///< pixels
    float opacity; ///< of what nothing hides
    float hidden; ///< of what lies behind a surface
    vec3 color;
    float padding;
};

SHARED_END

#endif
