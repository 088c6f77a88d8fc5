// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/random.glsl"
#include "techniques/per_triangle_volumes/clear_sums.glsl"
#include "techniques/per_triangle_volumes/traverse_bindings.glsl"
#include "shaders/material.glsl"

// Semitransparent casters. With one share for each triangle a tile that is wholly inside is done by one addition; where it differs by
// sample, all samples below are visited.
layout(constant_id = 2) const uint MODE = MODE_RGB;

layout(set = 0, binding = 12, scalar) buffer Red { uint red[]; }; // or grey
layout(set = 0, binding = 13, scalar) buffer Green { uint green[]; };
layout(set = 0, binding = 14, scalar) buffer Blue { uint blue[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { ClearConstants c; };
#define TREE c.tree

uvec3 share; // of the triangle at hand, where it has one

#include "techniques/per_triangle_volumes/volume.glsl"
#include "techniques/per_triangle_volumes/surface_at.glsl"

// Compare and swap, so that a sum can stop at the limit whoever else adds to it.
#define ADD(sums)                                                        \
    uint old = sums[i];                                                  \
    while (old < SUM_LIMIT) {                                            \
        const uint found = atomicCompSwap(sums[i], old, saturated(old, more)); \
        if (found == old) break;                                         \
        old = found;                                                     \
    }
void add_red(uint i, uint more) { ADD(red) }
void add_green(uint i, uint more) { ADD(green) }
void add_blue(uint i, uint more) { ADD(blue) }

void add(uint word, uint child, uvec3 more)
{
    const uint i = 32 * word + child;
    if (more.x != 0) add_red(i, more.x);
    if (MODE == MODE_ALPHA) return;
    if (more.y != 0) add_green(i, more.y);
    if (more.z != 0) add_blue(i, more.z);
}

// With the transmittance as probability. The samples of a pixel are in as many strata, each in one of its own.
bool passes_at_random(float transmittance, uint primitive, uvec2 at)
{
    const uint bits = c.side_log2.x + c.side_log2.y, strata = 1u << bits;
    const uvec2 pixel = at >> c.side_log2, within = at & ((uvec2(1) << c.side_log2) - 1u);
    const uint seed = hash3(uvec3(primitive, c.frame, 0x5bd1e995u)).x;
    const uint stratum = ((within.x | within.y << c.side_log2.x) ^ hash3(uvec3(pixel, seed)).x) & (strata - 1u);
    const uint jitter = hash3(uvec3(at, seed ^ 0x9e3779b9u)).y;
    const uint number = bits == 0 ? jitter : stratum << (32u - bits) | jitter >> bits;
    return transmittance >= 1.0 || number < uint(transmittance * 4294967296.0);
}

bool takes_tiles(Volume v) { return MODE == MODE_ALPHA || MODE == MODE_RGB; }

bool begins(Volume v)
{
    if (!takes_tiles(v)) return true;
    const vec3 through = mean_transmittance(v);
    share = MODE == MODE_ALPHA ? uvec3(sum_of(grey(through))) : uvec3(sum_of(through.r), sum_of(through.g), sum_of(through.b));
    return share != uvec3(0);
}

bool hits(Volume v, uvec2 at, vec3 e)
{
    if (texelFetch(primitive_image, ivec2(pixel_of(at)), 0).r == v.primitive) return false;
    if (takes_tiles(v)) return true;
    const vec3 through = transmittance_at(v, e);
    if (MODE == MODE_STOCHASTIC) return !passes_at_random(grey(through), v.primitive, at);
    if (through == vec3(0.0)) return true;
    const uint row = row_shift(1);
    add(node_index(1, at >> uvec2(row, 5 - row)), child_bit(1, at), uvec3(sum_of(through.r), sum_of(through.g), sum_of(through.b)));
    return false;
}

// What lets nothing through is as opaque as any caster.
void settle(uint word, uint children)
{
    if (MODE == MODE_TEXTURED || MODE == MODE_STOCHASTIC || share == uvec3(SUM_LIMIT)) {
        atomicOr(words[word], children);
        return;
    }
    for (; children != 0; children &= children - 1) add(word, findLSB(children), share);
}

#include "techniques/per_triangle_volumes/traverse.glsl"

void main() { run(); }
