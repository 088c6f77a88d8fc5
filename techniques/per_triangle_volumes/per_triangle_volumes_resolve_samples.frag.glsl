// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/per_triangle_volumes/clear_sums.glsl"
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

layout(constant_id = 0) const uint CHANNELS = 0; // of the sums

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, scalar) readonly buffer Words { uint words[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Red { uint red[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Green { uint green[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Blue { uint blue[]; };
layout(set = 1, binding = 0, scalar) uniform Constants
{
    Tree tree;
    uvec2 per_pixel;
};

#define TREE tree
#include "techniques/per_triangle_volumes/tree.glsl"

layout(location = 0) out vec4 through;

// What is set or summed up at a node holds for all samples below.
vec3 sample_through(uvec2 at)
{
    uvec3 sum = uvec3(0);
    for (uint height = 1; height <= tree.height; ++height) {
        const uint row = row_shift(height);
        const uvec2 node = at >> uvec2(row, 5 - row);
        const uint word = node_index(height, node), child = child_bit(height, at), i = 32 * word + child;
        if ((words[word] >> child & 1u) != 0) return vec3(0.0);
        if (CHANNELS > 0) sum.r = saturated(sum.r, red[i]);
        if (CHANNELS > 1) sum.g = saturated(sum.g, green[i]), sum.b = saturated(sum.b, blue[i]);
        at = node;
    }
    if (CHANNELS == 1) sum = sum.rrr;
    return vec3(transmittance_of(sum.r), transmittance_of(sum.g), transmittance_of(sum.b));
}

void main()
{
    const uvec2 first = uvec2(gl_FragCoord.xy) * per_pixel;
    vec3 mean = vec3(0.0);
    for (uint y = 0; y < per_pixel.y; ++y)
        for (uint x = 0; x < per_pixel.x; ++x) {
            const uvec2 at = first + uvec2(x, y);
            mean += texelFetch(depth_image, ivec2(pixel_of(at)), 0).r == 0.0 ? vec3(1.0) : sample_through(at);
        }
    through = vec4(mean / float(per_pixel.x * per_pixel.y), 1.0);
}
