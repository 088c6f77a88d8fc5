// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_ALIAS_FREE_CELLS_GLSL
#define GNOMON_ALIAS_FREE_CELLS_GLSL
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const int SAMPLES = 1; // of a pixel: 1, 8 or 32
const uint SAMPLE_BITS = SAMPLES == 32 ? 0xffffffffu : (1u << (SAMPLES & 31)) - 1u;

// Records take one vec4 for a point (xyz, primitive), three for a footprint.
const uint RECORD = SAMPLES == 1 ? 1u : 3u;

struct Cell {
    uint count; // of samples listed
    uint first; // of its records
    uint left; // samples that some caster may still darken
    uint furthest; // as furthest_code: 0 where the list is empty
};

// Stored depth is reversed and not negative: the order of such floats is that of their bits.
uint furthest_code(float z) { return 0x7f800000u - floatBitsToUint(max(z, 0.0)); }
float furthest_z(uint code) { return uintBitsToFloat(0x7f800000u - code); }

// Positions within a pixel, from its centre. A rank-1 lattice: each of n columns and rows holds one, so that an edge along either axis
// covers the right number to within one. 3 and 7 spread it best of all generators (greatest least distance, on the torus).
vec2 sub_pixel(int i)
{
    const int generator = SAMPLES == 32 ? 7 : 3;
    return (vec2(i, (i * generator) % SAMPLES) + 0.5) / float(SAMPLES) - 0.5;
}

#endif
