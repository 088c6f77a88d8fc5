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

bool hits_sample(Tree tree, Volume v, vec3 limits, uvec2 at)
{
    const vec3 p = vec3(sample_ndc(tree, at), receiver_depth(tree, texelFetch(depth_image, ivec2(at), 0).r));
    vec3 e;
    return is_inside(v, limits, p, e) && hits(v, at, e);
}

int classify_tile(Tree tree, Volume v, vec3 limits, uint height, uvec2 tile)
{
    const int verdict = classify(v, limits, node_box(tree, height, tile, tiles[node_index(tree, height, tile)]));
    return verdict == ACCEPT && !takes_tiles(v) ? REFINE : verdict;
}

// Tests the children of a node that are not settled yet, and returns those to descend into.
uint visit(Tree tree, Volume v, vec3 limits, uint height, uvec2 node)
{
    const uint word = node_index(tree, height, node);
    const uint open = team_first(~words[word]); // as it was some time ago, which only costs tests
    if (open == 0) return 0;
    if (team_elect()) count_tests(height - 1, bitCount(open));
    uint settled = 0, refined = 0;
    for (uint first = 0; first < 32; first += team_lanes) {
        const uint child = first + team_lane();
        const bool mine = child < 32 && (open >> child & 1u) != 0;
        int verdict = REJECT;
        if (mine) {
            const uvec2 at = child_of(height, node, child);
            if (height > 1)
                verdict = classify_tile(tree, v, limits, height - 1, at);
            else
                verdict = hits_sample(tree, v, limits, at) ? ACCEPT : REJECT;
        }
        settled |= team_ballot(verdict == ACCEPT) << first;
        refined |= team_ballot(verdict == REFINE) << first;
    }
    if (settled != 0 && team_elect()) settle(word, settled);
    return refined;
}

void traverse(Tree tree, Volume v, uint height, uvec2 node)
{
    const vec3 limits = side_limits(v.slot);
    const uint top = height;
    uint pending[TREE_MAX_HEIGHT + 1]; // by height
    pending[height] = visit(tree, v, limits, height, node);
    while (height <= top) {
        if (pending[height] == 0) {
            ++height;
            const uint row = row_shift(height);
            node >>= uvec2(row, 5 - row);
            continue;
        }
        const uint child = findLSB(pending[height]);
        pending[height] &= pending[height] - 1;
        node = child_of(height, node, child);
        --height;
        pending[height] = visit(tree, v, limits, height, node);
    }
}

#endif
