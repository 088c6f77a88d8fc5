// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/scene.glsl"
#include "techniques/alias_free/alias_free.shared.h"
#include "techniques/alias_free/alias_free_cells.glsl"

// One caster and one cell: every sample listed there is tested, and what the caster stands before is marked.
layout(early_fragment_tests) in;

layout(constant_id = 1) const bool MASKED = false;

layout(set = 0, binding = 0, scalar) buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};
layout(set = 0, binding = 1, scalar) readonly buffer Records { vec4 records[]; };
layout(set = 0, binding = 2, scalar) buffer Blocked { uint blocked[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { GridConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"

layout(location = 0) flat in vec3 edge_normal[3];
layout(location = 3) flat in vec3 edge_point[3];
layout(location = 6) flat in vec3 plane_normal;
layout(location = 7) flat in uvec4 ids; // layer + 8 level, primitive, instance, triangle

// Exactly the negative where another triangle has the same edge the other way round: a position on it belongs to both, and none falls
// between. No fused operation may spoil that.
float signed_volume(vec3 n, vec3 d)
{
    precise const float v = n.x * d.x + n.y * d.y + n.z * d.z;
    return v;
}

// `e`: volumes that the ray spans with each edge, which are the barycentric coordinates but for their sum. They have one sign where the
// line through the light meets the triangle. `below`: the height over the triangle's plane, which the light is above.
bool blocks(vec3 e, float below)
{
    if (!(below < 0.0)) return false;
    if (!(min(e.x, min(e.y, e.z)) >= 0.0 || max(e.x, max(e.y, e.z)) <= 0.0)) return false;
    return !MASKED || mask_keeps(ids.z, ids.w, e.yz / (e.x + e.y + e.z));
}

uint blocked_positions(uint at)
{
    const vec4 s = records[RECORD * at];
    if (floatBitsToUint(s.w) == ids.y) return 0;
    const vec3 e = vec3(signed_volume(edge_normal[0], s.xyz - edge_point[0]), signed_volume(edge_normal[1], s.xyz - edge_point[1]),
        signed_volume(edge_normal[2], s.xyz - edge_point[2]));
    const float below = dot(plane_normal, s.xyz - edge_point[0]);
    if (SAMPLES == 1) return blocks(e, below) ? 1u : 0u;

    // All four are linear over the footprint. No position is further than half of it from the middle: what holds for all of it is
    // decided at once, and half is more than enough that rounding cannot decide otherwise than position by position.
    const vec3 u = records[RECORD * at + 1].xyz, v = records[RECORD * at + 2].xyz;
    const float below_u = dot(plane_normal, u), below_v = dot(plane_normal, v);
    const vec3 e_u = vec3(signed_volume(edge_normal[0], u), signed_volume(edge_normal[1], u), signed_volume(edge_normal[2], u));
    const vec3 e_v = vec3(signed_volume(edge_normal[0], v), signed_volume(edge_normal[1], v), signed_volume(edge_normal[2], v));
    if (below - 0.5 * (abs(below_u) + abs(below_v)) >= 0.0) return 0;
    const vec3 swing = 0.5 * (abs(e_u) + abs(e_v));
    if (any(lessThan(e + swing, vec3(0.0))) && any(greaterThan(e - swing, vec3(0.0)))) return 0;
    uint bits = 0;
    for (int i = 0; i < SAMPLES; ++i) {
        const vec2 a = sub_pixel(i);
        precise const vec3 at_i = e + a.x * e_u + a.y * e_v;
        if (blocks(at_i, below + a.x * below_u + a.y * below_v)) bits |= 1u << i;
    }
    return bits;
}

void main()
{
    const GridLevel level = c.grid.level[ids.x >> 3u];
    const uvec2 xy = uvec2(gl_FragCoord.xy - level.corner);
    const uint cell = (ids.x & 7u) * c.grid.cells + level.first + xy.y * level.side + xy.x;
    // A count that is behind the times only costs tests.
    if (cells[cell].left == 0) return;
    const uint first = cells[cell].first, end = first + cells[cell].count;
    uint darkened = 0;
    for (uint at = first; at < end; ++at) {
        const uint bits = blocked_positions(at);
        if (bits == 0) continue;
        const uint old = atomicOr(blocked[at], bits);
        if (old != 0xffffffffu && (old | bits) == 0xffffffffu) ++darkened;
    }
    if (darkened != 0) atomicAdd(cells[cell].left, -darkened);
}
