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

// The depth that a caster has to reach to matter: the furthest sample's, less what rounding takes.
float reach_z(uint code) { return clamp(uintBitsToFloat(0x7f800000u - code) * (1.0 - 1e-4) - 1e-6, 0.0, 1.0); }

// Half the widest extent, in cells, of a footprint in its level's cells. At half a cell fewer footprints go to coarser levels, but each
// triangle looks into more cells: 366 against 310 ms on citadel, 32 positions; at an eighth 300, and 113 against 98 on balls.
const float FOOTPRINT_REACH = 0.25;

// Positions within a pixel, from its centre: Hammersley points, of which each of n columns and rows holds one. Their rows are exchanged
// (xor) so that of all such sets this one covers half-planes best: within 2.4 of 32 positions, or 1.6 of 8, of the area.
vec2 sub_pixel(int i)
{
    if (SAMPLES == 1) return vec2(0.0);
    const uint row = (bitfieldReverse(uint(i)) >> (32 - findLSB(SAMPLES))) ^ (SAMPLES == 32 ? 18u : 4u);
    return (vec2(i, row) + 0.5) / float(SAMPLES) - 0.5;
}

#endif
