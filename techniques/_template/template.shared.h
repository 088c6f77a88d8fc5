// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_TEMPLATE_SHARED_H
#define GNOMON_TEMPLATE_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

TECHNIQUE_BEGIN(template_id)

/// Defaults live here, ranges and sentences in template_id.cpp; nothing else names a parameter.
struct Params {
    int map_size DEFAULT(1024);
    float normal_offset DEFAULT(2.0f);
};

struct ResolveConstants {
    View view;
    Light light;
    LightMap map;
    Params params;
};

SHARED_END

#endif
