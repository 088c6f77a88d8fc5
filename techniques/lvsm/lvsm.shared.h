// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_LVSM_SHARED_H
#define GNOMON_LVSM_SHARED_H
#include "shaders/filter.shared.h"

#define LVSM_MAX_LAYERS 8
#define LVSM_BINS 1024

TECHNIQUE_BEGIN(lvsm)

struct Params {
    FilterParams filtering;
    int layers DEFAULT(4);
    int split DEFAULT(1);
    int format DEFAULT(1);
    float overlap DEFAULT(0.1f);
    float min_deviation DEFAULT(0.001f);
    float bleed_reduction DEFAULT(0.1f);
};

struct HistogramConstants {
    FilterValues map;
};

struct PlaceConstants {
    Params params;
};

struct ValuesConstants {
    FilterValues map;
    Params params;
};

struct ResolveConstants {
    FilterResolve filtering;
    Params params;
};

SHARED_END

#endif
