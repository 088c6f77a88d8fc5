// SPDX-License-Identifier: Apache-2.0
// Teams take volumes down the tree in two passes: the first down to nodes of 32 x 32 samples, which it lists; the second goes on from there
// with a team for each of these, so that a triangle over all of the picture keeps as many teams busy as one has. What finds no room in the
// list the first pass takes to its end itself. What becomes of tiles and samples in a volume is up to the includer:
//   bool begins(Volume)                       called before each volume; false where it darkens nothing
//   bool takes_tiles(Volume)                  whether a tile that is wholly inside is settled at once, or its samples one by one
//   bool hits(Volume, uvec2 sample, vec3 e)   whether a sample inside is hit; e as of is_inside
//   void settle(uint word, uint children)     called by one invocation of the team: children of a node, tiles or samples
// Include after traverse_bindings.glsl and TREE.
#ifndef GNOMON_TRAVERSE_GLSL
#define GNOMON_TRAVERSE_GLSL
#include "techniques/per_triangle_volumes/counting.glsl"
#include "techniques/per_triangle_volumes/volume.glsl"

layout(constant_id = 3) const uint PHASE = PHASE_EXPAND;

// `inside`: it is known already to lie in the volume, as all below a tile do that does.
bool hits_sample(Volume v, vec3 limits, uvec2 at, bool inside)
{
    const uvec2 pixel = pixel_of(at);
    const vec4 surface = texelFetch(depth_image, ivec2(pixel), 0);
    const vec3 p = vec3(sample_ndc(at), receiver_depth(depth_on(surface, at)));
    vec3 e;
    if (!is_inside(v, limits, p, e) && !inside) return false;
    // Where the plane of a pixel's triangle is carried on beyond its edge, in a hollow, it passes behind the next one, which the pixel's centre
    // does not.
    if (TREE.spread != uvec2(0) && plane_value(v.cap, vec3(pixel_ndc(pixel), receiver_depth(surface.x))) < 0.0) return false;
    return hits(v, at, e);
}

// Children to descend into. `certain` are those of them that lie inside, whose samples still differ.
struct Found {
    uint children, certain;
};

// Tests the children of a node that are not settled yet.
Found visit(Volume v, vec3 limits, uint height, uvec2 node, bool inside)
{
    const uint word = node_index(height, node);
    const uint open = team_first(~words[word]); // as it was some time ago, which only costs tests
    if (open == 0) return Found(0, 0);
    if (inside && height > 1) return Found(open, open);
    if (team_elect()) {
        if (height > 1)
            COUNT(counts.tile_tests, bitCount(open));
        else
            COUNT(counts.sample_tests, bitCount(open));
    }
    uint settled = 0, refined = 0; // of this lane's children
    for (uint child = team_lane(); child < 32; child += team_lanes) {
        if ((open >> child & 1u) == 0) continue;
        const uvec2 at = child_of(height, node, child);
        int verdict;
        if (height > 1)
            verdict = classify(v, limits, tile_box(height - 1, at, tiles[tile_index(word, child)]));
        else
            verdict = hits_sample(v, limits, at, inside) ? ACCEPT : REJECT;
        settled |= uint(verdict == ACCEPT) << child;
        refined |= uint(verdict == REFINE) << child;
    }
    settled = team_or(settled);
    if (height > 1) refined = team_or(refined);
    if (height > 1 && !takes_tiles(v)) return Found(refined | settled, settled);
    if (settled != 0 && team_elect()) settle(word, settled);
    return Found(height > 1 ? refined : 0, 0);
}

// From a node of 32 x 32 samples to the end.
void finish(Volume v, vec3 limits, uvec2 node, bool inside)
{
    const Found tiles = visit(v, limits, LISTED_HEIGHT, node, inside);
    for (uint left = tiles.children; left != 0; left &= left - 1) {
        const uint child = findLSB(left);
        visit(v, limits, LISTED_HEIGHT - 1, child_of(LISTED_HEIGHT, node, child), (tiles.certain >> child & 1u) != 0);
    }
}

// Lists children that are such nodes.
void list(Volume v, vec3 limits, uint volume, uvec2 parent, Found found)
{
    const uint number = bitCount(found.children);
    uint first = 0;
    if (team_elect()) {
        first = atomicAdd(listed, number);
        COUNT(counts.queue_entries, number);
    }
    first = team_first(first);
    const uint room = entries.length();
    for (uint child = team_lane(); child < 32; child += team_lanes) {
        const uint at = first + bitCount(found.children & ((1u << child) - 1u));
        if ((found.children >> child & 1u) == 0 || at >= room) continue;
        const uvec2 node = child_of(LISTED_HEIGHT + 1, parent, child);
        entries[at] = uvec2(volume << 1 | (found.certain >> child & 1u), node.x | node.y << 16);
    }
    uint left = found.children;
    for (uint at = first; left != 0; ++at, left &= left - 1) {
        const uint child = findLSB(left);
        if (at >= room) finish(v, limits, child_of(LISTED_HEIGHT + 1, parent, child), (found.certain >> child & 1u) != 0);
    }
}

void push(uint height, Found found)
{
    if (team_elect()) {
        team_stack[team_in_group()][height] = found.children;
        team_certain[team_in_group()][height] = found.certain;
    }
    TEAM_BARRIER;
}

// From the root to the nodes to be listed.
void expand(Volume v, uint volume)
{
    const vec3 limits = side_limits(v.slot);
    uint height = TREE.height;
    uvec2 node = uvec2(0);
    bool inside = false;
    for (;;) {
        const Found found = visit(v, limits, height, node, inside);
        if (height == LISTED_HEIGHT + 1 && found.children != 0) list(v, limits, volume, node, found);
        push(height, height == LISTED_HEIGHT + 1 ? Found(0, 0) : found);
        uint left;
        while ((left = team_first(team_stack[team_in_group()][height])) == 0) {
            if (height == TREE.height) return;
            ++height;
            const uint row = row_shift(height);
            node = team_same(node >> uvec2(row, 5 - row));
        }
        const uint child = findLSB(left), certain = team_first(team_certain[team_in_group()][height]);
        push(height, Found(left & (left - 1), certain));
        inside = (certain >> child & 1u) != 0;
        node = team_same(child_of(height, node, child));
        --height;
    }
}

vec4 volume_plane(TeamWords w, uint i)
{
    return uintBitsToFloat(uvec4(team_word_of(w, i), team_word_of(w, i + 1), team_word_of(w, i + 2), team_word_of(w, i + 3)));
}
vec3 volume_line(TeamWords w, uint i) { return uintBitsToFloat(uvec3(team_word_of(w, i), team_word_of(w, i + 1), team_word_of(w, i + 2))); }

Volume load_volume(uint volume)
{
    const TeamWords w = team_load(VOLUME_WORDS * volume);
    Volume v;
    v.side_0 = volume_plane(w, 0);
    v.side_1 = volume_plane(w, 4);
    v.side_2 = volume_plane(w, 8);
    v.cap = volume_plane(w, 12);
    v.line_0 = volume_line(w, 16);
    v.line_1 = volume_line(w, 19);
    v.line_2 = volume_line(w, 22);
    v.line_3 = volume_line(w, 25);
    v.primitive = team_word_of(w, 28);
    v.slot = team_word_of(w, 29);
    return v;
}

void run()
{
    const uint things = PHASE == PHASE_EXPAND ? made : min(listed, entries.length());
    const uint at = team_index();
    if (at >= things) return;
    const uvec2 entry = PHASE == PHASE_EXPAND ? uvec2(at << 1, 0) : entries[at];
    const Volume v = load_volume(entry.x >> 1);
    if (!begins(v)) return;
    if (PHASE == PHASE_EXPAND)
        expand(v, at);
    else
        finish(v, side_limits(v.slot), uvec2(entry.y & 0xffffu, entry.y >> 16), (entry.x & 1u) != 0);
}

#endif
