// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/material.glsl"
#include "shaders/random.glsl"
#include "techniques/per_triangle_volumes/clear_sums.glsl"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"
#include "techniques/per_triangle_volumes/team.glsl"
#define TREE c.tree

// Semitransparent casters. With one share for each triangle a tile that is wholly inside is done by one addition; where it differs by
// sample, all samples below are visited.
layout(constant_id = 2) const uint MODE = MODE_RGB;

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D primitive_image;
layout(set = 0, binding = 2, scalar) buffer Words { uint words[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Tiles { vec2 tiles[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Volumes
{
    uint count;
    Volume volumes[];
};
layout(set = 0, binding = 5, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 8, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 0, binding = 9, scalar) buffer Red { uint red[]; }; // or grey
layout(set = 0, binding = 10, scalar) buffer Green { uint green[]; };
layout(set = 0, binding = 11, scalar) buffer Blue { uint blue[]; };
layout(set = 0, binding = 12, scalar) buffer Counting { Counts counts; };
layout(set = 1, binding = 0, scalar) uniform Constants { ClearConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

uvec3 share; // of the triangle at hand, where it has one

#include "techniques/per_triangle_volumes/counting.glsl"
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
    const uint side = c.samples_log2 / 2, strata = 1u << c.samples_log2;
    const uvec2 pixel = at >> side, within = at & ((1u << side) - 1u);
    const uint seed = hash3(uvec3(primitive, c.frame, 0x5bd1e995u)).x;
    const uint stratum = ((within.x | within.y << side) ^ hash3(uvec3(pixel, seed)).x) & (strata - 1u);
    const uint jitter = hash3(uvec3(at, seed ^ 0x9e3779b9u)).y;
    const uint number = c.samples_log2 == 0 ? jitter : stratum << (32u - c.samples_log2) | jitter >> c.samples_log2;
    return transmittance >= 1.0 || number < uint(transmittance * 4294967296.0);
}

const bool INSIDE_IS_KNOWN = MODE == MODE_TEXTURED || MODE == MODE_STOCHASTIC;
bool takes_tiles(Volume v) { return !INSIDE_IS_KNOWN; }

bool hits(Volume v, uvec2 at, vec3 e)
{
    if (texelFetch(primitive_image, ivec2(at), 0).r == v.primitive) return false;
    if (takes_tiles(v)) return true;
    const vec3 through = transmittance_at(v, e);
    if (MODE == MODE_STOCHASTIC) return !passes_at_random(grey(through), v.primitive, at);
    if (through == vec3(0.0)) return true;
    const uint row = row_shift(1);
    add(node_index(1, at >> uvec2(row, 5 - row)), child_bit(1, at), uvec3(sum_of(through.r), sum_of(through.g), sum_of(through.b)));
    return false;
}

void count_tests(uint height, uint tests)
{
    if (height == 0) {
        COUNT(counts.sample_tests, tests);
    } else {
        COUNT(counts.tile_tests, tests);
    }
}

// What lets nothing through is as opaque as any caster.
void settle(uint word, uint children)
{
    if (INSIDE_IS_KNOWN || share == uvec3(SUM_LIMIT)) {
        atomicOr(words[word], children);
        return;
    }
    for (; children != 0; children &= children - 1) add(word, findLSB(children), share);
}

#include "techniques/per_triangle_volumes/traverse.glsl"

void main()
{
    const uint end = team_first(count);
    for (uint i = team_index(); i < end; i += team_count()) {
        const Volume v = volumes[i];
        if (takes_tiles(v)) {
            const vec3 through = mean_transmittance(v);
            share = MODE == MODE_ALPHA ? uvec3(sum_of(grey(through))) : uvec3(sum_of(through.r), sum_of(through.g), sum_of(through.b));
            if (share == uvec3(0)) continue;
        }
        traverse(v, TREE.height, uvec2(0));
    }
}
