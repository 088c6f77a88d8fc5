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

// What decides about all positions of one sample: volumes and height, linear over its footprint.
struct Signs {
    vec3 e, e_u, e_v;
    float below, below_u, below_v;
};

vec3 volumes(Caster t, vec3 d) { return vec3(signed_volume(t.normal_0, d), signed_volume(t.normal_1, d), signed_volume(t.normal_2, d)); }

// Whether the caster may stand before some position of the sample. No position is further than half of the footprint from its middle:
// what holds for all of that is decided at once, and half is more than enough that rounding cannot decide otherwise than one by one.
bool may_block(Caster t, uint at, out Signs s)
{
    const vec4 p = records[RECORD * at];
    s.e = vec3(signed_volume(t.normal_0, p.xyz - t.point_0), signed_volume(t.normal_1, p.xyz - t.point_1),
        signed_volume(t.normal_2, p.xyz - t.point_2));
    s.below = dot(t.plane, p.xyz - t.point_0);
    s.e_u = s.e_v = vec3(0.0);
    s.below_u = s.below_v = 0.0;
    if (floatBitsToUint(p.w) == t.primitive) return false;
    if (SAMPLES == 1) return blocks_light(t, s.e, s.below);
    const vec3 u = records[RECORD * at + 1].xyz, v = records[RECORD * at + 2].xyz;
    s.e_u = volumes(t, u);
    s.e_v = volumes(t, v);
    s.below_u = dot(t.plane, u);
    s.below_v = dot(t.plane, v);
    const vec3 swing = 0.5 * (abs(s.e_u) + abs(s.e_v));
    if (any(lessThan(s.e + swing, vec3(0.0))) && any(greaterThan(s.e - swing, vec3(0.0)))) return false;
    return s.below - 0.5 * (abs(s.below_u) + abs(s.below_v)) < 0.0;
}

// The positions before which it stands.
uint blocked_positions(Caster t, Signs s)
{
    if (SAMPLES == 1) return 1u; // may_block has decided
    const vec3 swing = 0.5 * (abs(s.e_u) + abs(s.e_v));
    const bool inside = all(greaterThan(s.e - swing, vec3(0.0))) || all(lessThan(s.e + swing, vec3(0.0)));
    if (inside && !t.masked && s.below + 0.5 * (abs(s.below_u) + abs(s.below_v)) < 0.0) return SAMPLE_BITS;
    uint bits = 0;
    for (int i = 0; i < SAMPLES; ++i) {
        const vec2 a = sub_pixel(i);
        precise const vec3 e = s.e + a.x * s.e_u + a.y * s.e_v;
        if (blocks_light(t, e, s.below + a.x * s.below_u + a.y * s.below_v)) bits |= 1u << i;
    }
    return bits;
}

// Marks them, and gives 1 where they were the last of the sample.
uint darken(Caster t, uint at, Signs s)
{
    const uint bits = blocked_positions(t, s);
    if (bits == 0) return 0;
    const uint old = atomicOr(blocked[at], bits);
    return old != 0xffffffffu && (old | bits) == 0xffffffffu ? 1 : 0;
}

// A count that is behind the times only costs tests.
bool is_open(uint cell, float z)
{
    const uint code = cells[cell].furthest;
    return code != 0 && z >= reach_z(code) && cells[cell].left != 0;
}

// Every sample listed in a cell is tested, and what the caster stands before is marked.
void test_cell(Caster t, uint cell)
{
    const uint first = cells[cell].first, end = first + cells[cell].count;
    uint darkened = 0;
    for (uint at = first; at < end; ++at) {
        Signs s;
        if (may_block(t, at, s)) darkened += darken(t, at, s);
    }
    if (darkened != 0) atomicAdd(cells[cell].left, -darkened);
}

#endif
