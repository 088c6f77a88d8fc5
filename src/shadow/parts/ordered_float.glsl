// SPDX-License-Identifier: Apache-2.0
// Least and greatest values by integer atomics, which, unlike those of floats, every device has. Unlike sums they do not depend on the order:
// results are the same in every run.
#ifndef GNOMON_ORDERED_FLOAT_GLSL
#define GNOMON_ORDERED_FLOAT_GLSL

// An integer for each float, in their order: negative ones count backwards. 0 and ~0 stand for none.
uint ordered_from_float(float f)
{
    const uint bits = floatBitsToUint(f);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float float_from_ordered(uint u) { return uintBitsToFloat((u & 0x80000000u) != 0u ? u & 0x7fffffffu : ~u); }

#endif
