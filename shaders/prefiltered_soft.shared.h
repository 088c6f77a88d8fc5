// SPDX-License-Identifier: Apache-2.0
// Blocks of the soft shadow methods that read averages over windows of one light map (shaders/prefiltered_soft.glsl).
#ifndef GNOMON_SHADERS_PREFILTERED_SOFT_SHARED_H
#define GNOMON_SHADERS_PREFILTERED_SOFT_SHARED_H
#include "shaders/filter.shared.h"
#include "shaders/soft_map.shared.h"

#define SUMS_INTEGER 0
#define SUMS_FLOAT 1

SHARED_BEGIN(shaders)

/// Parameters that they share (parts::describe_prefiltered_soft).
struct PrefilteredSoftParams {
    SoftParams soft;
    int sums DEFAULT(SUMS_INTEGER);
    float widest DEFAULT(0.0625f); ///< of the map
    int equal_area DEFAULT(1);
    float contact DEFAULT(0.01f); ///< scene radius
};

/// For shaders/prefiltered_soft.glsl.
struct PrefilteredSoft {
    float sum_step; ///< value of one count of integer sums
    float widest; ///< texels a side of the widest window
    float contact; ///< metres from blocker to receiver below which texels are compared
    float kernel_scale; ///< of the kernel's half width: to the area of a round light, or 1
};

SHARED_END

#endif
