// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_ALIAS_FREE_SHARED_H
#define GNOMON_ALIAS_FREE_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

#define GRID_MAX_LEVELS 11
#define GRID_HEADER 89 // words of Cells before its cells: `listed` and `used`
#define NOWHERE 0xffffffffu

TECHNIQUE_BEGIN(alias_free)

struct Params {
    int samples DEFAULT(0); ///< index into 1, 8, 32
    int grid DEFAULT(512);
    int grid_fit DEFAULT(1); ///< parts::Fit
};

/// A level's cells are twice as wide as those of the one before.
struct GridLevel {
    uint side; ///< cells
    uint first; ///< of its cells within a layer's
    float scale; ///< cells across the light map
    float padding;
    vec2 corner; ///< where it lies in the image of cells, in which each level has its place
};

struct Grid {
    uint levels;
    uint cells; ///< of one layer
    vec2 image; ///< width and height of the image of cells
    GridLevel level[GRID_MAX_LEVELS];
};

/// A triangle that covers many cells of a level of a layer.
struct WideCaster {
    uint slot, triangle, masked;
    uint place; ///< layer + 8 level
};

struct GridConstants {
    View view;
    Light light;
    LightMap map;
    Grid grid;
    uint blocks; ///< of casters
    uint wide; ///< room for as many wide casters
};

SHARED_END

#endif
