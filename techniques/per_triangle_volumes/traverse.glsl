// SPDX-License-Identifier: Apache-2.0
// A team takes one volume down the tree, depth first. What becomes of tiles and samples in it is up to the includer:
//   bool takes_tiles(Volume)                  whether a tile that is wholly inside is settled at once, or its samples one by one
//   bool hits(Volume, uvec2 sample, vec3 e)   whether a sample inside is hit; e as of is_inside
//   void count_tests(uint height, uint tests) of children of that height, called as settle is
//   void settle(uint word, uint children)     called by one invocation of the team: children of a node, tiles or samples
// Include after `words`, `tiles`, `depth_image` and team.glsl.
#ifndef GNOMON_TRAVERSE_GLSL
#define GNOMON_TRAVERSE_GLSL
#include "techniques/per_triangle_volumes/volume.glsl"

bool hits_sample(Volume v, vec3 limits, uvec2 at)
{
    const vec3 p = vec3(sample_ndc(at), receiver_depth(texelFetch(depth_image, ivec2(at), 0).r));
    vec3 e;
    return is_inside(v, limits, p, e) && hits(v, at, e);
}

int classify_tile(Volume v, vec3 limits, uint height, uvec2 tile)
{
    const int verdict = classify(v, limits, node_box(height, tile, tiles[node_index(height, tile)]));
    return verdict == ACCEPT && !takes_tiles(v) ? REFINE : verdict;
}

// Tests the children of a node that are not settled yet, and returns those to descend into.
uint visit(Volume v, vec3 limits, uint height, uvec2 node)
{
    const uint word = node_index(height, node);
    const uint open = team_first(~words[word]); // as it was some time ago, which only costs tests
    if (open == 0) return 0;
    if (team_elect()) count_tests(height - 1, bitCount(open));
    uint settled = 0, refined = 0; // of this lane's children
    for (uint child = team_lane(); child < 32; child += team_lanes) {
        if ((open >> child & 1u) == 0) continue;
        const uvec2 at = child_of(height, node, child);
        int verdict;
        if (height > 1)
            verdict = classify_tile(v, limits, height - 1, at);
        else
            verdict = hits_sample(v, limits, at) ? ACCEPT : REJECT;
        settled |= uint(verdict == ACCEPT) << child;
        refined |= uint(verdict == REFINE) << child;
    }
    settled = team_or(settled);
    if (settled != 0 && team_elect()) settle(word, settled);
    return height > 1 ? team_or(refined) : 0;
}

void push(uint height, uint children)
{
    if (team_elect()) team_pending[team_in_group()][height] = children;
    TEAM_BARRIER;
}

void traverse(Volume v, uint height, uvec2 node)
{
    const vec3 limits = side_limits(v.slot);
    const uint top = height;
    push(height, visit(v, limits, height, node));
    while (height <= top) {
        const uint left = team_first(team_pending[team_in_group()][height]);
        if (left == 0) {
            ++height;
            const uint row = row_shift(height);
            node >>= uvec2(row, 5 - row);
            continue;
        }
        push(height, left & (left - 1));
        node = child_of(height, node, findLSB(left));
        --height;
        push(height, visit(v, limits, height, node));
    }
}

#endif
