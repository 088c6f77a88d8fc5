// SPDX-License-Identifier: Apache-2.0
// Deterministic numbers: a hash of position and seed, never a clock.
#ifndef GNOMON_RANDOM_GLSL
#define GNOMON_RANDOM_GLSL

// PCG permutation in three dimensions (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg3d).
uvec3 hash3(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    return v;
}

// Uniform in [0,1): 24 bits, so that 1 is never reached.
vec2 random2(uvec3 v) { return vec2(hash3(v).xy >> 8u) * (1.0 / 16777216.0); }

#endif
