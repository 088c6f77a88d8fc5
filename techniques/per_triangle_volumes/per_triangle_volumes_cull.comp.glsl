// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"
#include "src/shadow/parts/caster_blocks.shared.h"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"

// Blocks of triangles whose shadow may reach a sample. A ball around each stands for it: what lies behind the ball is bounded by a pyramid
// of four planes through the light, which touch the ball, and a fifth before it.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer Words { uint words[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Tiles { uint tiles[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Blocks { CasterBlock blocks[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Boxes { CasterBox boxes[]; };
layout(set = 0, binding = 4, scalar) buffer Work { uint made, listed, kept; };
layout(set = 0, binding = 5, scalar) writeonly buffer Kept { uint kept_blocks[]; };
layout(set = 0, binding = 6, scalar) buffer Counting { Counts counts; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeConstants c; };
#define TREE c.tree

#include "techniques/per_triangle_volumes/counting.glsl"
#include "techniques/per_triangle_volumes/volume_setup.glsl"

struct Pyramid {
    vec4 side_0, side_1, side_2, side_3, front;
};

// Of the ball whose centre lies `far` from the light along `axis`.
Pyramid pyramid_behind(vec3 centre, float radius, vec3 axis, float far)
{
    vec3 u, v;
    orthonormal_basis(axis, u, v);
    const float s = c.light.kind == LIGHT_DIRECTIONAL ? 0.0 : radius / far, k = sqrt(max(1.0 - s * s, 0.0));
    // Inwards: turned from the sideways direction by half the pyramid's angle.
    const vec3 n_0 = k * u + s * axis, n_1 = -k * u + s * axis, n_2 = k * v + s * axis, n_3 = -k * v + s * axis;
    return Pyramid(ndc_plane(n_0, centre - radius * n_0), ndc_plane(n_1, centre - radius * n_1), ndc_plane(n_2, centre - radius * n_2),
        ndc_plane(n_3, centre - radius * n_3), ndc_plane(axis, centre - radius * axis));
}

bool touches(Pyramid p, Box b)
{
    return most(p.side_0, b) >= 0.0 && most(p.side_1, b) >= 0.0 && most(p.side_2, b) >= 0.0 && most(p.side_3, b) >= 0.0
        && most(p.front, b) >= 0.0;
}

bool touches_below(Pyramid p, uint height, uvec2 node)
{
    const uint word = node_index(height, node);
    for (uint open = ~words[word]; open != 0; open &= open - 1) {
        const uint child = findLSB(open);
        if (touches(p, tile_box(height - 1, child_of(height, node, child), tiles[tile_index(word, child)]))) return true;
    }
    return false;
}

// Two heights of the tree are looked at.
bool reaches(CasterBox box)
{
    const vec3 from_light = c.light.kind == LIGHT_DIRECTIONAL ? c.light.direction : box.centre - c.light.position;
    // half as much again as rounding at the light's and the eye's distance takes
    const float radius = length(box.half_size) * 1.0001 + 4e-6 * (length(box.centre - c.eye) + length(from_light));
    const float far = length(from_light);
    if (!(far > 1.01 * radius) && c.light.kind != LIGHT_DIRECTIONAL) return true; // the light is in it
    const Pyramid p = pyramid_behind(box.centre, radius, from_light / far, far);
    const uint top = TREE.height, word = TREE.nodes - 1;
    for (uint open = ~words[word]; open != 0; open &= open - 1) {
        const uint child = findLSB(open);
        const uvec2 at = child_of(top, uvec2(0), child);
        if (touches(p, tile_box(top - 1, at, tiles[tile_index(word, child)])) && touches_below(p, top - 1, at)) return true;
    }
    return false;
}

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= c.blocks) return;
    if (reaches(boxes[c.first_block + i])) {
        kept_blocks[atomicAdd(kept, 1)] = c.first_block + i;
        return;
    }
    COUNT(counts.triangles, blocks[c.first_block + i].count);
    COUNT(counts.triangles_culled, blocks[c.first_block + i].count);
    COUNT(counts.blocks_culled, 1);
}
