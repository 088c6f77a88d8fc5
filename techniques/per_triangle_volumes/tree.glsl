// SPDX-License-Identifier: Apache-2.0
// Before including it, define TREE: the Tree in the pass's constants. It is no argument, because lavapipe copies the arrays of an argument.
#ifndef GNOMON_TREE_GLSL
#define GNOMON_TREE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

const float NOWHERE = 1e30; // beyond all depths

// Nodes are stored by rows. A tile's depths lie with its siblings', as its bit does; those of the root are the last.
// Words hold a bit for each child of a node: set where nothing below is left to darken, because all of it is dark, faces away from the
// light, is background, or does not exist.
uint node_index(uint height, uvec2 node) { return TREE.first[height] + node.y * TREE.width[height] + node.x; }

// Children of a node lie in rows of 2^this.
uint row_shift(uint height) { return 2 + (height & 1); }

uvec2 child_of(uint height, uvec2 node, uint child)
{
    const uint row = row_shift(height);
    return (node << uvec2(row, 5 - row)) + uvec2(child & ((1u << row) - 1u), child >> row);
}

uint child_bit(uint height, uvec2 child)
{
    const uint row = row_shift(height);
    return (child.x & ((1u << row) - 1u)) + ((child.y & ((1u << (5 - row)) - 1u)) << row);
}

uint tile_index(uint parent, uint child) { return 32 * (parent - TREE.first[2]) + child; }
uint tile_index(uint height, uvec2 node)
{
    if (height == TREE.height) return tile_index(TREE.nodes, 0);
    const uint row = row_shift(height + 1);
    return tile_index(node_index(height + 1, node >> uvec2(row, 5 - row)), child_bit(height + 1, node));
}

// Of a sample's centre. The sum is exact and the product is rounded once, so that x does not decrease from one sample to the next: a tile's
// first and last sample bound those between bit for bit.
vec2 sample_ndc(uvec2 at)
{
    precise const vec2 x = vec2(ivec2(2 * at + 1) - ivec2(TREE.samples)) * TREE.step;
    return x;
}

// Of a pixel's centre, among the samples that it is spread to.
vec2 pixel_ndc(uvec2 pixel)
{
    precise const vec2 x = vec2(ivec2((2 * pixel + 1) << TREE.spread) - ivec2(TREE.samples)) * TREE.step;
    return x;
}

uvec2 pixel_of(uvec2 at) { return at >> TREE.spread; }

// `surface`: the pixel's depth and slopes (per_triangle_volumes_slopes.frag.glsl). A depth image, with nothing in its other channels, is the same
// without slopes.
float depth_on(vec4 surface, uvec2 at)
{
    if (TREE.spread == uvec2(0)) return surface.x;
    const vec2 width = vec2(uvec2(1) << TREE.spread), offset = (vec2(at & ((uvec2(1) << TREE.spread) - 1u)) + 0.5) / width - 0.5;
    precise const float z = surface.x + (surface.y * offset.x + surface.z * offset.y);
    return z;
}

// A sample's depth is off by a few roundings, and it must not lie behind its own surface. It is moved towards the eye, off the side that is
// seen; every plane of every triangle then sees the same point, so that what holds for all points behind a closed surface holds for it. (A
// bias of the triangles' own planes let light in through those that the light sees edge-on.)
float receiver_depth(float depth)
{
    precise const float z = depth + ((depth * TREE.nearer.z + TREE.nearer.y) * depth + TREE.nearer.x);
    return z;
}

// The least and greatest depth below a node in 16 bits each, rounded outwards: the five lowest bits of a float's exponent, above which there is
// nothing, and the eleven highest of its fraction. Depths under 2^-30 are taken for 0 to 2^-30.
const uint DEPTH_BASE = 97u << 23;
const uint NO_TILE = 0xffffu;

uint depth_code(float depth) { return uint(clamp(int(floatBitsToUint(depth)) - int(DEPTH_BASE), 0, 0xfffffff)) >> 12; }
uint pack_depths(vec2 depths) { return depths.x > depths.y ? NO_TILE : depth_code(depths.x) | min(depth_code(depths.y) + 1, 0xffffu) << 16; }
vec2 unpack_depths(uint code)
{
    const uvec2 both = uvec2(code & 0xffffu, code >> 16);
    return vec2(both.x == 0 ? 0.0 : uintBitsToFloat((both.x << 12) + DEPTH_BASE), both.y == 0xffffu ? NOWHERE : uintBitsToFloat((both.y << 12) + DEPTH_BASE));
}

// Of all samples below a node that may still be darkened.
struct Box {
    vec2 x, y, z; // least and greatest
};

Box tile_box(uint height, uvec2 node, uint code)
{
    const uvec2 shift = tree_shift(height);
    const vec2 least = sample_ndc(node << shift), most = sample_ndc(min((node + 1) << shift, TREE.samples) - 1);
    return Box(vec2(least.x, most.x), vec2(least.y, most.y), unpack_depths(code));
}

#endif
