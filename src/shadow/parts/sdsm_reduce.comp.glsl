// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_basic : require
#include "src/shadow/parts/sdsm.glsl"
#include "src/shadow/parts/sdsm_sample.glsl"

// Bounds of the samples of the picture, or, of one cascade each, along z.
layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, scalar) buffer Fitted { FittedMap fitted; };
layout(set = 1, binding = 0, scalar) uniform Constants { SdsmReduce c; };

layout(constant_id = 0) const bool of_cascades = false;

const int tile = 64; // pixels a side of a group: fewer groups than pixels add to one place in memory

void main()
{
    const int cascade = int(gl_WorkGroupID.z);
    const vec2 range = of_cascades ? fitted.ranges[cascade] : vec2(-1e38, 1e38);
    vec4 least = vec4(1e38), greatest = vec4(-1e38);
    const ivec2 first = ivec2(gl_WorkGroupID.xy) * tile + ivec2(gl_LocalInvocationID.xy), end = min((ivec2(gl_WorkGroupID.xy) + 1) * tile, ivec2(c.view.size));
    for (int y = first.y; y < end.y; y += 16)
        for (int x = first.x; x < end.x; x += 16) {
            const float depth = texelFetch(depth_image, ivec2(x, y), 0).r;
            if (depth == 0.0) continue; // background
            const vec4 s = sample_of(c, ivec2(x, y), depth);
            if (s.x < range.x || s.x > range.y) continue;
            least = min(least, s);
            greatest = max(greatest, s);
        }
    least = subgroupMin(least);
    greatest = subgroupMax(greatest);
    if (!subgroupElect() || least.x > greatest.x) return;
    for (int k = 0; k < 4; ++k) {
        if (of_cascades) {
            atomicMin(fitted.cascades[cascade].least[k], ordered_from_float(least[k]));
            atomicMin(fitted.cascades[cascade].least_negated[k], ordered_from_float(-greatest[k]));
        } else {
            atomicMin(fitted.all.least[k], ordered_from_float(least[k]));
            atomicMin(fitted.all.least_negated[k], ordered_from_float(-greatest[k]));
        }
    }
}
