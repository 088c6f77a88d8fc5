// SPDX-License-Identifier: Apache-2.0
// Blocks of every prefiltered map: depth is turned into values whose averages mean something, the averages are made once a texel, and
// receivers read one of them.
#ifndef GNOMON_SHADERS_FILTER_SHARED_H
#define GNOMON_SHADERS_FILTER_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

#define PREFILTER_BOX 0
#define PREFILTER_GAUSSIAN 1
#define PREFILTER_MIPS 2
#define PREFILTER_SUMS 3

SHARED_BEGIN(shaders)

/// Parameters that all prefiltered maps share (parts::describe_filter).
struct FilterParams {
    int map_size DEFAULT(1024);
    FitParams fitting;
    int kernel DEFAULT(9);
    int prefilter DEFAULT(0); ///< PREFILTER_*
    float bias DEFAULT(0.06f); ///< widths of the window
};

/// For shaders/filter_values.glsl: one layer of depth to values.
struct FilterValues {
    LightMapLayer layer;
    int index;
    int prefilter;
};

/// For shaders/filter_resolve.glsl.
struct FilterResolve {
    View view;
    Light light;
    LightMap map;
    FilterParams params;
    int groups; ///< array layers of values for each layer of the map
    float shift; ///< texels from a receiver to where its window's mean lies: half a one for even kernels
    float sum_step; ///< PREFILTER_SUMS: value of one count
    float widest; ///< PREFILTER_SUMS: texels a side of the widest window with exact sums
};

SHARED_END

#endif
