// SPDX-License-Identifier: Apache-2.0
// A host's stream: elements at any multiple of two bytes.
#ifndef GNOMON_HOST_GATHER_SOURCE_GLSL
#define GNOMON_HOST_GATHER_SOURCE_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "src/host/gather.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Source { uint words[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { GatherConstants c; };

uint read_16(uint at) { return words[at / 4] >> (at % 4 * 8) & 0xffffu; }
uint read_32(uint at) { return at % 4 == 0 ? words[at / 4] : read_16(at) | read_16(at + 2) << 16; }

// Component `k` of element `i`.
float read_float(uint i, uint k)
{
    const uint at = c.offset + i * c.stride;
    if (c.format == GATHER_FLOAT32) return uintBitsToFloat(read_32(at + 4 * k));
    const uint bits = read_16(at + 2 * k);
    if (c.format == GATHER_FLOAT16) return unpackHalf2x16(bits).x;
    return c.format == GATHER_SNORM16 ? unpackSnorm2x16(bits).x : unpackUnorm2x16(bits).x;
}

#endif
