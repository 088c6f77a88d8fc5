// SPDX-License-Identifier: Apache-2.0
// Percentage-closer filtering: compare first, then average. All filters read a depth map without a comparison sampler, four texels a
// gather, and compare each texel with the receiver's plane at its centre. `coned` false says that plane.cone is 0.
#ifndef GNOMON_PERCENTAGE_CLOSER_GLSL
#define GNOMON_PERCENTAGE_CLOSER_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/receiver_plane.glsl"

#define RECONSTRUCT_NEAREST 0
#define RECONSTRUCT_BILINEAR 1
#define RECONSTRUCT_BICUBIC 2

// Bent planes are followed up to a quarter of their scale: at 0 lies their horizon.
const float nearest_horizon = 0.25;

// What the texels `first` + (0,1) (1,1) (1,0) (0,0), a gather's order, are compared with: no less than 0, so that where nothing was
// drawn is lit.
vec4 reference_four(ReceiverPlane r, vec2 first, bool coned)
{
    const vec2 d = first + 0.5 - r.at;
    const vec4 dx = d.x + vec4(0.0, 1.0, 1.0, 0.0), dy = d.y + vec4(1.0, 1.0, 0.0, 0.0);
    vec4 z = (r.slope.x * dx + r.slope.y * dy) / max(1.0 + r.bend.x * dx + r.bend.y * dy, nearest_horizon);
    if (coned) z = max(z, r.cone * sqrt(dx * dx + dy * dy));
    return max(r.z + z, 0.0);
}

// Whether these texels are lit.
vec4 compare_four(sampler2DArray map, int layer_index, ReceiverPlane r, vec2 first, vec2 texel, bool coned)
{
    const vec4 stored = textureGather(map, vec3((first + 1.0) * texel, float(layer_index)));
    return step(stored, reference_four(r, first, coned));
}

// The nearest texel: its stored depth, and what that is compared with.
vec2 nearest_tap(sampler2DArray map, int layer_index, ReceiverPlane r, vec2 at, vec2 texel, bool coned)
{
    const vec2 centre = clamp(floor(at), vec2(0.0), 1.0 / texel - 1.0) + 0.5;
    const vec2 offset = centre - r.at;
    float z = dot(r.slope, offset) / max(1.0 + dot(r.bend, offset), nearest_horizon);
    if (coned) z = max(z, r.cone * length(offset));
    return vec2(texelFetch(map, ivec3(centre, layer_index), 0).r, max(r.z + z, 0.0));
}

// One tap d texels from the receiver: a 2 x 2 block blended, or the nearest texel.
float compare_tap(sampler2DArray map, int layer_index, ReceiverPlane r, vec2 d, vec2 texel, bool bilinear, bool coned)
{
    const vec2 at = r.at + d;
    if (bilinear) {
        const vec2 first = floor(at - 0.5), f = at - 0.5 - first;
        const vec4 lit = compare_four(map, layer_index, r, first, texel, coned);
        return mix(mix(lit.w, lit.z, f.x), mix(lit.x, lit.y, f.x), f.y);
    }
    const vec2 tap = nearest_tap(map, layer_index, r, at, texel, coned);
    return step(tap.x, tap.y);
}

// Tap i of n along one axis; `exponent` is that of separable_filter.
float tap_weight(int i, int n, float exponent, bool gaussian)
{
    const float x = float(i) - 0.5 * float(n - 1);
    return i < 0 || i >= n ? 0.0 : gaussian ? exp2(exponent * x * x) : 1.0;
}

// Weights of the texels j and j + 1 along one axis: texel j gets the share b[k] of tap j - k.
vec2 texel_weights(int j, int n, vec4 b, float exponent, bool gaussian, int reconstruct)
{
    const float t0 = tap_weight(j, n, exponent, gaussian);
    if (reconstruct == RECONSTRUCT_NEAREST) return vec2(t0, tap_weight(j + 1, n, exponent, gaussian));
    const float t1 = tap_weight(j - 1, n, exponent, gaussian), before = tap_weight(j + 1, n, exponent, gaussian);
    const vec2 w = b.xx * vec2(t0, before) + b.yy * vec2(t1, t0);
    if (reconstruct == RECONSTRUCT_BILINEAR) return w;
    const float t2 = tap_weight(j - 2, n, exponent, gaussian), t3 = tap_weight(j - 3, n, exponent, gaussian);
    return w + b.zz * vec2(t2, t1) + b.ww * vec2(t3, t2);
}

// The share of a tap in the texels along one axis, f past the second of four (bicubic) or the first of two: uniform cubic B-spline,
// or linear.
vec4 reconstruction(float f, int reconstruct)
{
    if (reconstruct == RECONSTRUCT_NEAREST) return vec4(1.0, 0.0, 0.0, 0.0);
    if (reconstruct == RECONSTRUCT_BILINEAR) return vec4(1.0 - f, f, 0.0, 0.0);
    const float g = 1.0 - f, f2 = f * f, g2 = g * g;
    return vec4(g * g2, 4.0 + 3.0 * f2 * (f - 2.0), 4.0 + 3.0 * g2 * (g - 2.0), f * f2) / 6.0;
}

// n x n taps one texel apart around the receiver, of equal weight or Gaussian (standard deviation n / 6), each reconstructed from 1, 2 x 2
// or 4 x 4 texels. Taps overlap, so that their sum is one weighted sum over n, n + 1 or n + 3 texels a side. n = 1 with bicubic
// is Sigg and Hadwiger's filter (2005). With `adaptive`, 3 x 3 gathers over the window come first, and decide where they agree
// (Uralsky 2005).
float separable_filter(
    sampler2DArray map, int layer_index, ReceiverPlane r, int n, bool gaussian, int reconstruct, bool coned, bool adaptive)
{
    const vec2 texel = 1.0 / vec2(textureSize(map, 0).xy);
    const vec2 corner = r.at - 0.5 * float(n) + (reconstruct == RECONSTRUCT_NEAREST ? 0.5 : 0.0);
    const vec2 f = fract(corner);
    const vec2 first = floor(corner) - (reconstruct == RECONSTRUCT_BICUBIC ? 1.0 : 0.0);
    const int count = n + (reconstruct == RECONSTRUCT_BICUBIC ? 3 : reconstruct == RECONSTRUCT_BILINEAR ? 1 : 0);
    if (adaptive && count > 6) {
        float agree = 0.0;
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x)
                agree += dot(compare_four(map, layer_index, r, first + floor(0.5 * vec2(x, y) * float(count - 2)), texel, coned), vec4(1.0));
        if (agree == 0.0 || agree == 36.0) return agree / 36.0;
    }
    // exp(-x^2 / (2 sigma^2)) as a power of two
    const float exponent = -0.5 * 1.44269504 * 36.0 / float(n * n);
    const vec4 bx = reconstruction(f.x, reconstruct), by = reconstruction(f.y, reconstruct);
    float sum = 0.0, weight = 0.0;
    for (int y = 0; y < count; y += 2) {
        const vec2 wy = texel_weights(y, n, by, exponent, gaussian, reconstruct);
        weight += wy.x + wy.y;
        float row = 0.0;
        for (int x = 0; x < count; x += 2) {
            const vec2 wx = texel_weights(x, n, bx, exponent, gaussian, reconstruct);
            const vec4 lit = compare_four(map, layer_index, r, first + vec2(x, y), texel, coned);
            row += dot(lit, vec4(wx.x * wy.y, wx.y * wy.y, wx.y * wy.x, wx.x * wy.x));
        }
        sum += row;
    }
    return min(sum / (weight * weight), 1.0); // both axes have the same sum of weights, to rounding
}

#endif
