// SPDX-License-Identifier: Apache-2.0
// One caster before the samples of one cell. Include after the blocks named below and shaders/alpha.glsl's.
#ifndef GNOMON_ALIAS_FREE_CASTER_GLSL
#define GNOMON_ALIAS_FREE_CASTER_GLSL

// A triangle as the light sees it. No arrays: a struct that holds one is slow to pass.
struct Caster {
    vec3 normal_0, normal_1, normal_2; // of the planes through the light and the edge opposite to each corner
    vec3 point_0, point_1, point_2; // on those edges
    vec3 plane; // the triangle's own normal, towards the light; 0 where the light's rays lie in it: they never cross it
    uint primitive, slot, triangle;
    bool masked;
};

// Exactly the negative where another triangle has the same edge the other way round: a position on it belongs to both, and none falls
// between. No fused operation may spoil that.
float signed_volume(vec3 n, vec3 d)
{
    precise const float v = n.x * d.x + n.y * d.y + n.z * d.z;
    return v;
}

// `e`: volumes that the ray spans with each edge, which are the barycentric coordinates but for their sum. They have one sign where the
// line through the light meets the triangle. `below`: the height over the triangle's plane, which the light is above.
bool blocks_light(Caster t, vec3 e, float below)
{
    if (!(below < 0.0)) return false;
    if (!(min(e.x, min(e.y, e.z)) >= 0.0 || max(e.x, max(e.y, e.z)) <= 0.0)) return false;
    return !t.masked || mask_keeps(t.slot, t.triangle, e.yz / (e.x + e.y + e.z));
}

uint blocked_positions(Caster t, uint at)
{
    const vec4 s = records[RECORD * at];
    if (floatBitsToUint(s.w) == t.primitive) return 0;
    const vec3 e = vec3(signed_volume(t.normal_0, s.xyz - t.point_0), signed_volume(t.normal_1, s.xyz - t.point_1),
        signed_volume(t.normal_2, s.xyz - t.point_2));
    const float below = dot(t.plane, s.xyz - t.point_0);
    if (SAMPLES == 1) return blocks_light(t, e, below) ? 1u : 0u;

    // All four are linear over the footprint. No position is further than half of it from the middle: what holds for all of it is
    // decided at once, and half is more than enough that rounding cannot decide otherwise than position by position.
    const vec3 u = records[RECORD * at + 1].xyz, v = records[RECORD * at + 2].xyz;
    const float below_u = dot(t.plane, u), below_v = dot(t.plane, v);
    if (below - 0.5 * (abs(below_u) + abs(below_v)) >= 0.0) return 0;
    const vec3 e_u = vec3(signed_volume(t.normal_0, u), signed_volume(t.normal_1, u), signed_volume(t.normal_2, u));
    const vec3 e_v = vec3(signed_volume(t.normal_0, v), signed_volume(t.normal_1, v), signed_volume(t.normal_2, v));
    const vec3 swing = 0.5 * (abs(e_u) + abs(e_v));
    if (any(lessThan(e + swing, vec3(0.0))) && any(greaterThan(e - swing, vec3(0.0)))) return 0;
    uint bits = 0;
    for (int i = 0; i < SAMPLES; ++i) {
        const vec2 a = sub_pixel(i);
        precise const vec3 e_i = e + a.x * e_u + a.y * e_v;
        if (blocks_light(t, e_i, below + a.x * below_u + a.y * below_v)) bits |= 1u << i;
    }
    return bits;
}

// Every sample listed in a cell is tested, and what the caster stands before is marked.
void test_cell(Caster t, uint cell)
{
    // A count that is behind the times only costs tests.
    if (cells[cell].left == 0) return;
    const uint first = cells[cell].first, end = first + cells[cell].count;
    uint darkened = 0;
    for (uint at = first; at < end; ++at) {
        const uint bits = blocked_positions(t, at);
        if (bits == 0) continue;
        const uint old = atomicOr(blocked[at], bits);
        if (old != 0xffffffffu && (old | bits) == 0xffffffffu) ++darkened;
    }
    if (darkened != 0) atomicAdd(cells[cell].left, -darkened);
}

#endif
