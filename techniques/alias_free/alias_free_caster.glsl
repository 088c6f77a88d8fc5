// SPDX-License-Identifier: Apache-2.0
// One caster before the samples of one cell. Include after the blocks named below and shaders/alpha.glsl's.
#ifndef GNOMON_ALIAS_FREE_CASTER_GLSL
#define GNOMON_ALIAS_FREE_CASTER_GLSL

// A triangle as the light sees it. No arrays: a struct that holds one is slow to pass.
struct Caster {
    vec3 normal_0, normal_1, normal_2; // of the planes through the light and the edge opposite to each corner
    vec3 point_0, point_1, point_2; // on those edges
    vec3 plane; // the triangle's own normal, towards the light; 0 where the light's rays lie in it: they never cross it
    vec4 lengths; // of the three normals and the plane's
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
    const bool inside = min(e.x, min(e.y, e.z)) >= 0.0 || max(e.x, max(e.y, e.z)) <= 0.0;
    if (!(below < 0.0 && inside)) return false;
    return !t.masked || mask_keeps(t.slot, t.triangle, e.yz / (e.x + e.y + e.z));
}

vec3 volumes(Caster t, vec3 d_0, vec3 d_1, vec3 d_2)
{
    return vec3(signed_volume(t.normal_0, d_0), signed_volume(t.normal_1, d_1), signed_volume(t.normal_2, d_2));
}

// A sample's middle: volumes, and the height over the triangle's plane.
struct Signs {
    vec3 e;
    float below;
    float radius; // of the footprint
};

// Whether the caster may stand before some position of the sample. What holds for a ball around its footprint is decided at once; the
// ball has room to spare, so that rounding cannot decide otherwise than position by position.
bool may_block(Caster t, uint at, out Signs s)
{
    const vec4 p = records[RECORD * at];
    s.e = volumes(t, p.xyz - t.point_0, p.xyz - t.point_1, p.xyz - t.point_2);
    s.below = dot(t.plane, p.xyz - t.point_0);
    s.radius = p.w;
    if (SAMPLES == 1) return floatBitsToUint(p.w) != t.primitive && blocks_light(t, s.e, s.below);
    const vec3 swing = t.lengths.xyz * s.radius;
    return s.below < t.lengths.w * s.radius && !(any(lessThan(s.e + swing, vec3(0.0))) && any(greaterThan(s.e - swing, vec3(0.0))));
}

// The positions before which it stands.
uint blocked_positions(Caster t, uint at, Signs s)
{
    if (SAMPLES == 1) return 1u; // may_block has decided
    const vec4 u = records[RECORD * at + 1];
    if (floatBitsToUint(u.w) == t.primitive) return 0;
    // Volumes and height are linear over the footprint. Positions stay a 32nd of its sides within its rim, which is more than rounding takes:
    // what holds at the rim is what position by position would say.
    const vec3 v = records[RECORD * at + 2].xyz;
    const vec3 e_u = volumes(t, u.xyz, u.xyz, u.xyz), e_v = volumes(t, v, v, v);
    const float below_u = dot(t.plane, u.xyz), below_v = dot(t.plane, v);
    const vec3 swing = 0.5 * (abs(e_u) + abs(e_v));
    const float rise = 0.5 * (abs(below_u) + abs(below_v));
    const bvec3 front = greaterThan(s.e, swing), back = lessThan(s.e, -swing);
    if (s.below > rise || (any(front) && any(back))) return 0;
    if (!t.masked && s.below < -rise && (all(front) || all(back))) return SAMPLE_BITS;
    uint bits = 0;
    for (int i = 0; i < SAMPLES; ++i) {
        const vec2 a = sub_pixel(i);
        precise const vec3 e = fma(vec3(a.x), e_u, fma(vec3(a.y), e_v, s.e));
        if (blocks_light(t, e, fma(a.x, below_u, fma(a.y, below_v, s.below)))) bits |= 1u << i;
    }
    return bits;
}

// Marks them, and gives 1 where they were the last of the sample.
uint darken(Caster t, uint at, Signs s)
{
    if (SAMPLES > 1 && blocked[at] == 0xffffffffu) return 0; // as it was some time ago, which is enough
    const uint bits = blocked_positions(t, at, s);
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
