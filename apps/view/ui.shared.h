// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VIEW_UI_SHARED_H
#define GNOMON_VIEW_UI_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

// What a triangle of the user interface is filled from; Dear ImGui's texture ids.
#define UI_FONT 0
#define UI_CANVAS 1
#define UI_INSETS 2

struct UiConstants {
    vec2 scale; ///< clip = scale * position + offset
    vec2 offset;
};

SHARED_END

#endif
