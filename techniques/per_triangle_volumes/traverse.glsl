// SPDX-License-Identifier: Apache-2.0
// A team takes one volume down the tree, depth first. What becomes of tiles and samples in it is up to the includer:
//   const bool INSIDE_IS_KNOWN                whether what lies below a tile that is wholly inside is spared the test; costs time elsewhere
//   bool takes_tiles(Volume)                  whether a tile that is wholly inside is settled at once, or its samples one by one
//   bool hits(Volume, uvec2 sample, vec3 e)   whether a sample inside is hit; e as of is_inside
//   void count_tests(uint height, uint tests) of children of that height, called as settle is
//   void settle(uint word, uint children)     called by one invocation of the team: children of a node, tiles or samples
// Include after `words`, `tiles`, `depth_image` and team.glsl.
#ifndef GNOMON_TRAVERSE_GLSL
#define GNOMON_TRAVERSE_GLSL
#include "techniques/per_triangle_volumes/volume.glsl"

bool hits_sample(Volume v, vec3 limits, uvec2 at, bool inside)
{
    const vec3 p = vec3(sample_ndc(at), receiver_depth(texelFetch(depth_image, ivec2(at), 0).r));
    vec3 e;
    return (is_inside(v, limits, p, e) || inside) && hits(v, at, e);
}

int classify_tile(Volume v, vec3 limits, uint height, uvec2 tile)
{
    return classify(v, limits, node_box(height, tile, tiles[node_index(height, tile)]));
}

// Tests the children of a node that are not settled yet, and returns those to descend into. `certain` are those of them that lie inside,
// if their samples differ all the same.
uint visit(Volume v, vec3 limits, uint height, uvec2 node, bool inside, out uint certain)
{
    certain = 0;
    const uint word = node_index(height, node);
    const uint open = team_first(~words[word]); // as it was some time ago, which only costs tests
    if (open == 0 || (INSIDE_IS_KNOWN && inside && height > 1)) return open;
    if (team_elect()) count_tests(height - 1, bitCount(open));
    uint settled = 0, refined = 0; // of this lane's children
    for (uint child = team_lane(); child < 32; child += team_lanes) {
        if ((open >> child & 1u) == 0) continue;
        const uvec2 at = child_of(height, node, child);
        int verdict;
        if (height > 1)
            verdict = classify_tile(v, limits, height - 1, at);
        else
            verdict = hits_sample(v, limits, at, INSIDE_IS_KNOWN && inside) ? ACCEPT : REJECT;
        settled |= uint(verdict == ACCEPT) << child;
        refined |= uint(verdict == REFINE) << child;
    }
    settled = team_or(settled);
    if (height > 1 && !takes_tiles(v)) {
        if (INSIDE_IS_KNOWN) certain = settled;
        return team_or(refined) | settled;
    }
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
    // Children that lie inside come before those to be tested, so that there is one node at a time that has any.
    uint certain, certain_height = 0, found;
    push(height, visit(v, limits, height, node, false, found));
    if (INSIDE_IS_KNOWN && found != 0) certain = found, certain_height = height;
    while (height <= top) {
        const uint left = team_first(team_pending[team_in_group()][height]);
        if (left == 0) {
            ++height;
            const uint row = row_shift(height);
            node >>= uvec2(row, 5 - row);
            continue;
        }
        if (height == certain_height && certain == 0) certain_height = 0;
        const bool inside = INSIDE_IS_KNOWN && height <= certain_height;
        const uint child = findLSB(inside && height == certain_height ? certain : left);
        if (inside && height == certain_height) certain &= certain - 1;
        push(height, left & ~(1u << child));
        node = child_of(height, node, child);
        --height;
        push(height, visit(v, limits, height, node, inside, found));
        if (INSIDE_IS_KNOWN && found != 0) certain = found, certain_height = height;
    }
}

#endif
