// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_CSSM_SHARED_H
#define GNOMON_CSSM_SHARED_H
#include "shaders/prefiltered_soft.shared.h"

#define CSSM_SUMS 0
#define CSSM_MIPS 1
#define CORRECT_NONE 0
#define CORRECT_SHARPEN 1
#define CORRECT_LEVEL 2
// A map of 512 texels, windows of up to a quarter of it; a macro, since GLSL takes no commas in DEFAULT.
#define CSSM_MAP                                                                                                                           \
    {                                                                                                                                      \
        {512}, SUMS_INTEGER, 0.25f                                                                                                         \
    }

TECHNIQUE_BEGIN(cssm)

struct Params {
    PrefilteredSoftParams prefiltered DEFAULT(CSSM_MAP);
    int terms DEFAULT(4);
    int prefilter DEFAULT(CSSM_SUMS);
    int format DEFAULT(1);
    int tight DEFAULT(1);
    int iterations DEFAULT(2);
    float least DEFAULT(0.005f);
    int correction DEFAULT(CORRECT_LEVEL);
    float sharpening DEFAULT(30.0f);
    float reach DEFAULT(40.0f);
};

/// The series in use (cssm_series.h). Lengths are of the wave's half period, which `fill` of is all depths.
struct Series {
    int groups; ///< of two terms
    float scale;
    float shift;
    float fill;
};

struct ValuesConstants {
    FilterValues map;
    Series series;
    int tight;
    int times_depth;
};

struct ResolveConstants {
    SoftResolve soft;
    PrefilteredSoft prefiltered;
    Params params;
    Series series;
};

SHARED_END

#endif
