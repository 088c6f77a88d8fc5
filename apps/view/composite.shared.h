// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VIEW_COMPOSITE_SHARED_H
#define GNOMON_VIEW_COMPOSITE_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

SHARED_BEGIN(shaders)

// In the order of view::show_names().
#define SHOW_LIT 0
#define SHOW_VISIBILITY 1
#define SHOW_ERROR 2
#define SHOW_DEPTH 3
#define SHOW_NORMAL 4
#define SHOW_GEOMETRIC_NORMAL 5
#define SHOW_ALBEDO 6
#define SHOW_SURFACE 7
#define SHOW_PRIMITIVE 8
#define SHOW_POSITION 9
#define SHOW_FOOTPRINT 10
#define SHOW_FOOTPRINT_PERSPECTIVE 11
#define SHOW_FOOTPRINT_PROJECTION 12

#define RIGHT_NONE 0
#define RIGHT_MISSING 1 ///< asked for, but there is no picture of it yet
#define RIGHT_TECHNIQUE 2
#define RIGHT_TRUTH 3

struct CompositeConstants {
    View view;
    uint show; ///< SHOW_*
    uint right; ///< RIGHT_*
    float split; ///< pixels: right of it lies the other side
    float exposure; ///< radiance times this
    float range; ///< of the error map
    float farthest; ///< metres: depth is shown up to there
    float extent; ///< metres: largest coordinate
    uint wireframe, layers, volumes, inspect; ///< 0 or 1
    uint left_colored, right_colored; ///< 1: the visibility has three channels
};

#define INSPECT_COLORS 6

/// For an image that a technique offers for inspection.
struct InspectConstants {
    View view;
    uint label; ///< 1: whole numbers, a colour each; 0: a quantity
    uint in_pixels; ///< 1: metres are divided by a pixel's width at the surface
    float most; ///< where the colours end
    vec3 colors[INSPECT_COLORS];
};

/// For the passes that read the technique's map.
struct MapOverlayConstants {
    View view;
    LightMap map;
    uint columns, cell; ///< of the insets: layers beside one another, pixels a side
};

SHARED_END

#endif
