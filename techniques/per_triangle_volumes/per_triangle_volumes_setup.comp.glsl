// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shaders/light.glsl"
#include "shaders/scene.glsl"
#include "src/shadow/parts/caster_blocks.shared.h"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"
#define TREE c.tree

// An invocation makes the volume of a triangle, where that reaches into the tree at all.
layout(local_size_x = CASTER_BLOCK) in;

layout(set = 0, binding = 0, scalar) readonly buffer Words { uint words[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Tiles { uint tiles[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Blocks { CasterBlock blocks[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Volumes { Volume volumes[]; };
layout(set = 0, binding = 8, scalar) buffer Work { uint made, listed, kept; };
layout(set = 0, binding = 9, scalar) readonly buffer Kept { uint kept_blocks[]; };
layout(set = 0, binding = 10, scalar) buffer Counting { Counts counts; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeConstants c; };

#include "techniques/per_triangle_volumes/counting.glsl"
#include "techniques/per_triangle_volumes/volume_setup.glsl"

vec3 corner_of(Instance i, uint triangle, uint k)
{
    const vec3 p = positions[i.first_vertex + indices[i.first_index + 3 * triangle + k]];
    precise const vec3 world = vec3(exact_dot(i.row_x.xyz, p) + i.row_x.w, exact_dot(i.row_y.xyz, p) + i.row_y.w, exact_dot(i.row_z.xyz, p) + i.row_z.w);
    return world;
}

// Whether the triangle shows the light the side that is left out. Only of single-sided materials, which promise to be closed.
bool is_culled(Instance i, bool front)
{
    return c.cull != CULL_NONE && (materials[i.material].flags & MATERIAL_DOUBLE_SIDED) == 0 && front == (c.cull == CULL_FRONT);
}

// Large ones are likely to darken much: its part of what the light sees, or of the scene's breadth for parallel light.
bool is_large(Sorted s, float height)
{
    const float far = length(from_point_to_light(s.a));
    return abs(height) > c.large * far * far * far;
}

bool append(Volume v)
{
    const Box root = tile_box(TREE.height, uvec2(0), tiles[tile_index(TREE.height, uvec2(0))]);
    const bool reaches = finite(v.side_0) && finite(v.side_1) && finite(v.side_2) && finite(v.cap) && words[TREE.nodes - 1] != 0xffffffffu
        && classify(v, side_limits(v.slot), root) != REJECT;
    if (reaches) volumes[atomicAdd(made, 1)] = v;
    return reaches;
}

// Whether any of it is left.
bool append_triangle(CasterBlock block, uint triangle)
{
    const Instance i = instances[block.slot];
    const Sorted s = sorted(corner_of(i, triangle, 0), corner_of(i, triangle, 1), corner_of(i, triangle, 2));
    vec3 n;
    float doubt;
    const float height = light_height(s, n, doubt);
    // Without area, or with the light exactly in its plane, a triangle meets no ray.
    if (height == 0.0 || isnan(height)) return false;
    const bool even = s.from == uvec3(0, 1, 2) || s.from == uvec3(1, 2, 0) || s.from == uvec3(2, 0, 1);
    if (is_culled(i, (height > 0.0) == even)) return false;
    if (c.which != WHICH_ALL && is_large(s, height) != (c.which == WHICH_LARGE)) return false;
    // Where rounding may have turned the sign both are tried for the sides: the one that is wrong holds nothing but what rounding left
    // between planes.
    const bool doubtful = abs(height) <= doubt;
    bool casts = false;
    for (float turn = -1.0; turn < 2.0; turn += 2.0) {
        if (!doubtful && turn * height < 0.0) continue;
        Volume v = make_volume(s, n, height, turn);
        v.primitive = i.first_primitive + triangle;
        v.slot |= block.slot << 4 | block.masked * VOLUME_MASKED;
        casts = append(v) || casts;
    }
    return casts;
}

void main()
{
    const CasterBlock block = blocks[kept_blocks[gl_WorkGroupID.x]];
    const uint triangle = block.first + gl_LocalInvocationIndex;
    if (gl_LocalInvocationIndex >= block.count) return;
    const bool casts = append_triangle(block, triangle);
    COUNT(counts.triangles, 1);
    COUNT(counts.triangles_culled, casts ? 0 : 1);
}
