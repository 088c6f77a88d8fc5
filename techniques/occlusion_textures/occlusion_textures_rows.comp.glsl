// SPDX-License-Identifier: Apache-2.0
// Counts of covered texels, of two slices in each word: four in the low halves, four in the high ones. Differences of running sums of such
// words are the sums of both halves as long as neither reaches 2^16.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures_cover.glsl"

layout(set = 0, binding = 1) writeonly uniform uimage2DArray to;

#define VALUE uvec4
VALUE load(ivec3 p)
{
    const int group = 2 * (p.z / c.layers), layer = p.z % c.layers;
    const uvec4 low = uvec4(covers(p.xy, group, layer));
    return group + 1 < c.groups ? low | uvec4(covers(p.xy, group + 1, layer)) << 16 : low;
}
void store(ivec3 p, VALUE v) { imageStore(to, p, v); }
#include "src/shadow/parts/summed_area_scan.glsl"

void main() { scan_rows(textureSize(slices, 0).xy); }
