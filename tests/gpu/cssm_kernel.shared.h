// SPDX-License-Identifier: Apache-2.0
// One box kernel over a small field of depths, and what convolution soft shadow mapping makes of it.
#ifndef GNOMON_TESTS_CSSM_KERNEL_SHARED_H
#define GNOMON_TESTS_CSSM_KERNEL_SHARED_H
#include "techniques/cssm/cssm.shared.h"

#define CSSM_FIELD 16 // texels a side of a field

SHARED_BEGIN(shaders)

struct SeriesCase {
    int field; ///< which of the fields
    vec2 lo;
    vec2 hi;
    float t; ///< receiver's depth on [-1, 1]
    int groups;
    float scale;
    float shift;
    float fill;
    int bits; ///< of stored sines and cosines; 0: floats
    float least;
    float z; ///< blockers' depth that levels are taken at
};

struct SeriesResult {
    float lit; ///< not cut
    float level; ///< of depth z
    float levelled; ///< visibility with the level taken into account
    vec2 blocker; ///< blocked fraction, mean depth relative to the receiver
};

SHARED_END

#endif
