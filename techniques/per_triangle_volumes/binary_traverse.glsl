// SPDX-License-Identifier: Apache-2.0
// Opaque and masked casters: a hit sample is dark.
#ifndef GNOMON_BINARY_TRAVERSE_GLSL
#define GNOMON_BINARY_TRAVERSE_GLSL
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/scene.glsl"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"

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
layout(set = 0, binding = 9, scalar) buffer Counting { Counts counts; };
layout(set = 1, binding = 0, scalar) uniform Constants { Tree tree; };
#define TREE tree
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"
#include "techniques/per_triangle_volumes/counting.glsl"

const bool INSIDE_IS_KNOWN = false;
bool takes_tiles(Volume v) { return (v.slot & VOLUME_MASKED) == 0; }

// A triangle does not darken itself.
bool hits(Volume v, uvec2 at, vec3 e)
{
    if (texelFetch(primitive_image, ivec2(at), 0).r == v.primitive) return false;
    if ((v.slot & VOLUME_MASKED) == 0) return true;
    const uint slot = v.slot >> 4;
    return mask_keeps(slot, v.primitive - instances[slot].first_primitive, e.yz / (e.x + e.y + e.z));
}

void count_tests(uint height, uint tests)
{
    if (height == 0)
        COUNT(counts.sample_tests, tests);
    else
        COUNT(counts.tile_tests, tests);
}

void settle(uint word, uint children) { atomicOr(words[word], children); }

#include "techniques/per_triangle_volumes/traverse.glsl"

void traverse_all()
{
    const uint end = team_first(count);
    for (uint i = team_index(); i < end; i += team_count()) traverse(volumes[i], tree.height, uvec2(0));
}

#endif
