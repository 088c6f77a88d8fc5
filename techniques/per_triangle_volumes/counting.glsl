// SPDX-License-Identifier: Apache-2.0
// What a pass did, for Frame::counters; nothing where nobody asks.
#ifndef GNOMON_PER_TRIANGLE_VOLUMES_COUNTING_GLSL
#define GNOMON_PER_TRIANGLE_VOLUMES_COUNTING_GLSL

layout(constant_id = 1) const uint COUNTING = 0;

// What is counted: `Counts counts` of the pass.
#define COUNT(name, number)                          \
    do {                                             \
        if (COUNTING != 0) atomicAdd(name, number);  \
    } while (false)

#endif
