// SPDX-License-Identifier: Apache-2.0
// One box kernel over a small field of depths, and what variance soft shadow mapping makes of it.
#ifndef GNOMON_TESTS_VSSM_KERNEL_SHARED_H
#define GNOMON_TESTS_VSSM_KERNEL_SHARED_H
#include "shaders/shared.h"

#define VSSM_FIELD 32 // texels a side of a field

SHARED_BEGIN(shaders)

struct KernelCase {
    int field; ///< which of the fields
    vec2 lo;
    vec2 hi;
    float t; ///< receiver's centred depth at the field's origin
    vec2 slope DEFAULT(vec2(0.0f)); ///< of its plane, a texel
    int subdivision DEFAULT(2);
    int height DEFAULT(3);
    int per_cell DEFAULT(1);
    float flat_deviation DEFAULT(0.0f);
    float min_deviation DEFAULT(0.0f);
};

struct KernelResult {
    float area; ///< of all that was counted
    float compared;
    float pooled; ///< visibility with one bound for all undivided parts
    float per_cell; ///< with one for each
    vec2 blocker; ///< area, and mean depth relative to the receiver
};

SHARED_END

#endif
