// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_TEXEL_FOOTPRINT_SHARED_H
#define GNOMON_TEXEL_FOOTPRINT_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

SHARED_BEGIN(shaders)

struct TexelFootprintConstants {
    View view;
    LightMap map;
};

SHARED_END

#endif
