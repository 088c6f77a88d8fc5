// SPDX-License-Identifier: Apache-2.0
// Least and greatest values by integer atomics, which, unlike those of floats, every device has: the order of additions does not matter, and
// results are the same in every run.
#ifndef GNOMON_SDSM_GLSL
#define GNOMON_SDSM_GLSL
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/sdsm.shared.h"

// An integer for each float, in their order: negative ones count backwards.
uint ordered_from_float(float f)
{
    const uint bits = floatBitsToUint(f);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float float_from_ordered(uint u) { return uintBitsToFloat((u & 0x80000000u) != 0u ? u & 0x7fffffffu : ~u); }

bool any_sample(SampleBounds b) { return b.least[0] != ~0u; }
float least(SampleBounds b, int k) { return float_from_ordered(b.least[k]); }
float most(SampleBounds b, int k) { return -float_from_ordered(b.least_negated[k]); }

#endif
