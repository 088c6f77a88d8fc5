// SPDX-License-Identifier: Apache-2.0
// What passes over blocks of casting triangles share: a group for each block, an invocation for each triangle.
#ifndef GNOMON_VOLUME_TRIANGLES_GLSL
#define GNOMON_VOLUME_TRIANGLES_GLSL
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_sides.glsl"

layout(local_size_x = VOLUME_GROUP) in;

layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Blocks { VolumeBlock blocks[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

vec3[3] corners_of(Instance i, uint triangle)
{
    vec3 p[3];
    for (uint k = 0; k < 3; ++k) p[k] = placed(i, positions[i.first_vertex + indices[i.first_index + 3 * triangle + k]]);
    return p;
}

#endif
