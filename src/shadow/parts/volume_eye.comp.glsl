// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "src/shadow/parts/volume_triangles.glsl"
#include "src/shadow/parts/volume_weights.glsl"

layout(set = 0, binding = 4, scalar) readonly buffer Sides { int sides[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Weights { ivec4 weights[]; };
layout(set = 0, binding = 6, scalar) buffer Eye { int eye[4]; };

bool before(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

// From p to where counting begins: an orthographic eye is at infinity; or at the other end of its rays, which all meet there.
vec3 eye_from(vec3 p)
{
    if (c.count == VOLUME_ZFAIL) return c.view.forward;
    return c.view.orthographic != 0 ? -c.view.forward : c.view.eye - p;
}

// On which side of the plane through an edge and the light the eye lies. Both triangles at an edge start from the same end of it, so that
// an eye in the plane is in the volume of one.
bool left_of(vec3 from, vec3 to)
{
    const bool swapped = before(to, from);
    const vec3 point = swapped ? to : from;
    precise const vec3 along = (swapped ? from : to) - point, ray = light_from(c.light, point), d = eye_from(point);
    precise const vec3 n = vec3(ray.y * along.z - ray.z * along.y, ray.z * along.x - ray.x * along.z, ray.x * along.y - ray.y * along.x);
    precise const float volume = n.x * d.x + n.y * d.y + n.z * d.z;
    return (volume >= 0.0) != swapped;
}

void main()
{
    const uint index = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (index >= c.blocks) return;
    const VolumeBlock block = blocks[index];
    bool inside = gl_LocalInvocationIndex < block.count;
    if (inside) {
        const Instance i = instances[block.slot];
        const uint triangle = block.first + gl_LocalInvocationIndex;
        const vec3 p[3] = corners_of(i, triangle);
        const int side = sides[i.first_primitive + triangle];
        const bool left = side > 0;
        inside = side != 0 && dot(cross(p[1] - p[0], p[2] - p[0]), eye_from(p[0])) * float(side) < 0.0 && left_of(p[0], p[1]) == left
            && left_of(p[1], p[2]) == left && left_of(p[2], p[0]) == left;
    }
    const int count = subgroupAdd(inside ? 1 : 0);
    if (count == 0 || !subgroupElect()) return;
    const ivec4 weight = COLOURED ? weights[block.slot] * count : ivec4(count);
    for (int k = 0; k < 4; ++k) atomicAdd(eye[k], weight[k]);
}
