// SPDX-License-Identifier: Apache-2.0
// Ids instead of depths (Hourcade and Nicolas 1985), one for each placed mesh: a texel that shows the receiver's own lets light through
// whatever its depth, any other is compared.
#ifndef GNOMON_IDS_GLSL
#define GNOMON_IDS_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/percentage_closer.glsl"

// The filter of n x n taps one texel apart, as separable_filter's boxes.
float ids_filter(
    sampler2DArray map, usampler2DArray ids, int layer_index, ReceiverPlane r, uint own, int n, bool bilinear)
{
    const vec2 texel = 1.0 / vec2(textureSize(map, 0).xy);
    const int reconstruct = bilinear ? RECONSTRUCT_BILINEAR : RECONSTRUCT_NEAREST;
    const vec2 corner = r.at - 0.5 * float(n) + (bilinear ? 0.0 : 0.5);
    const vec2 f = fract(corner), first = floor(corner);
    const vec4 bx = reconstruction(f.x, reconstruct), by = reconstruction(f.y, reconstruct);
    const int count = n + (bilinear ? 1 : 0);
    float sum = 0.0;
    for (int y = 0; y < count; y += 2) {
        const vec2 wy = texel_weights(y, n, by, 0.0, false, reconstruct);
        for (int x = 0; x < count; x += 2) {
            const vec2 wx = texel_weights(x, n, bx, 0.0, false, reconstruct), at = first + vec2(x, y);
            const uvec4 id = textureGather(ids, vec3((at + 1.0) * texel, float(layer_index)));
            const vec4 lit = max(compare_four(map, layer_index, r, at, texel, false), vec4(equal(id, uvec4(own))));
            sum += dot(lit, vec4(wx.x * wy.y, wx.y * wy.y, wx.y * wy.x, wx.x * wy.x));
        }
    }
    return min(sum / float(n * n), 1.0);
}

#endif
