// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_BACK_PROJECTION_SHARED_H
#define GNOMON_BACK_PROJECTION_SHARED_H
#include "shaders/n_buffer.shared.h"
#include "shaders/soft_map.shared.h"

#define SEARCH_MAP 0
#define RANGES_PYRAMID 0
#define RANGES_Y_MAP 1
#define RANGES_MULTISCALE 2

TECHNIQUE_BEGIN(back_projection)

struct Params {
    SoftParams soft DEFAULT((SoftParams{1024, {}, 0.25f}));
    int layers DEFAULT(2);
    int occluders DEFAULT(0);
    int accumulate DEFAULT(2);
    int gaps DEFAULT(1);
    int search DEFAULT(2);
    int ranges DEFAULT(RANGES_PYRAMID);
    int levels DEFAULT(1);
    int budget DEFAULT(32);
};

struct ResolveConstants {
    SoftResolve soft;
    Params params;
    NBuffer windows; ///< RANGES_Y_MAP, RANGES_MULTISCALE
};

SHARED_END

#endif
