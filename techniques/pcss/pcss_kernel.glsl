// SPDX-License-Identifier: Apache-2.0
// The two loops of percentage-closer soft shadows over a window of the map, `half_size` texels to each side of the receiver: every texel
// by the part that the window covers, or scattered taps.
#ifndef GNOMON_PCSS_KERNEL_GLSL
#define GNOMON_PCSS_KERNEL_GLSL
#include "shaders/percentage_closer.glsl"

// Part of each of four texels, in a gather's order, inside the box or the ellipse.
vec4 covered_four(vec2 at, vec2 half_size, vec2 first)
{
    if (box) {
        const vec2 lo = at - half_size - first, hi = at + half_size - first;
        const vec2 a = clamp(min(hi, 1.0) - max(lo, 0.0), 0.0, 1.0), b = clamp(min(hi, 2.0) - max(lo, 1.0), 0.0, 1.0);
        return vec4(a.x * b.y, b.x * b.y, b.x * a.y, a.x * a.y);
    }
    const vec2 d = first + 0.5 - at;
    const vec4 dx = (d.x + vec4(0.0, 1.0, 1.0, 0.0)) / half_size.x, dy = (d.y + vec4(1.0, 1.0, 0.0, 0.0)) / half_size.y;
    return clamp((1.0 - sqrt(dx * dx + dy * dy)) * min(half_size.x, half_size.y) + 0.5, 0.0, 1.0);
}

vec4 depths_from_stored(LightMapLayer layer, vec4 z)
{
    if (layer.perspective != 0) return layer.near * layer.far / (z * (layer.far - layer.near) + layer.near);
    return layer.far - z * (layer.far - layer.near);
}

// How much a blocker in the window's centre counts more than one at its rim (Burley 2006): 64 times in the corners of t = 1.
vec4 centre_weight(vec4 t_squared) { return centred ? exp2(-6.0 * t_squared) : vec4(1.0); }

vec2 placed_tap(vec2 tap, mat2 turn, vec2 shift) { return box ? shifted_tap(tap, shift) : turn * tap; }

// Small windows hold fewer gathers than a pattern has taps: all their texels are read.
bool exhaustive(vec2 half_size, int taps)
{
    const vec2 gathers = half_size + (box ? 1.0 : 2.0);
    return pattern == PCSS_GRID || gathers.x * gathers.y <= float(taps);
}

// x: sum of the blockers' depths in metres, y: sum of their weights.
vec2 search_window(LightMapLayer layer, int index, ReceiverPlane plane, vec2 half_size)
{
    const vec2 texel = 1.0 / vec2(textureSize(map_image, 0).xy);
    vec2 sum = vec2(0.0);
    if (exhaustive(half_size, c.params.search_taps)) {
        const vec2 first = floor(plane.at - half_size - (box ? 0.0 : 1.0)), last = plane.at + half_size + (box ? 0.0 : 1.0);
        for (float y = first.y; y < last.y; y += 2.0)
            for (float x = first.x; x < last.x; x += 2.0) {
                const vec4 stored = textureGather(map_image, vec3((vec2(x, y) + 1.0) * texel, float(index)));
                const vec4 blocks = 1.0 - step(stored, reference_four(plane, vec2(x, y), coned));
                if (blocks == vec4(0.0)) continue;
                const vec2 d = vec2(x, y) + 0.5 - plane.at;
                const vec4 dx = (d.x + vec4(0.0, 1.0, 1.0, 0.0)) / half_size.x, dy = (d.y + vec4(1.0, 1.0, 0.0, 0.0)) / half_size.y;
                const vec4 w = blocks * covered_four(plane.at, half_size, vec2(x, y)) * centre_weight(dx * dx + dy * dy);
                sum += vec2(dot(w, depths_from_stored(layer, stored)), dot(w, vec4(1.0)));
            }
        return sum;
    }
    const mat2 turn = box ? mat2(1.0) : tap_rotation(rotation, noise_image, ivec2(gl_FragCoord.xy), c.soft.view.frame);
    const vec2 shift = box ? tap_shift(rotation, noise_image, ivec2(gl_FragCoord.xy), c.soft.view.frame) : vec2(0.0);
    for (int i = 0; i < c.params.search_taps; ++i) {
        const vec2 t = placed_tap(c.search[i], turn, shift);
        const vec2 tap = nearest_tap(map_image, index, plane, plane.at + half_size * t, texel, coned);
        if (tap.x > tap.y) sum += centre_weight(vec4(dot(t, t))).x * vec2(depth_from_stored(layer, tap.x), 1.0);
    }
    return sum;
}

// The fraction of the window that is not nearer than the receiver.
float filter_window(int index, ReceiverPlane plane, vec2 half_size)
{
    const vec2 texel = 1.0 / vec2(textureSize(map_image, 0).xy);
    if (exhaustive(half_size, c.params.filter_taps)) {
        const vec2 first = floor(plane.at - half_size - (box ? 0.0 : 1.0)), last = plane.at + half_size + (box ? 0.0 : 1.0);
        float lit = 0.0, weight = 0.0;
        for (float y = first.y; y < last.y; y += 2.0)
            for (float x = first.x; x < last.x; x += 2.0) {
                const vec4 w = covered_four(plane.at, half_size, vec2(x, y));
                lit += dot(w, compare_four(map_image, index, plane, vec2(x, y), texel, coned));
                weight += dot(w, vec4(1.0));
            }
        return min(lit / weight, 1.0);
    }
    const mat2 turn = box ? mat2(1.0) : tap_rotation(rotation, noise_image, ivec2(gl_FragCoord.xy), c.soft.view.frame);
    const vec2 shift = box ? tap_shift(rotation, noise_image, ivec2(gl_FragCoord.xy), c.soft.view.frame) : vec2(0.0);
    float lit = 0.0;
    for (int i = 0; i < c.params.filter_taps; ++i)
        lit += compare_tap(map_image, index, plane, half_size * placed_tap(c.taps[i], turn, shift), texel, true, coned);
    return lit / float(c.params.filter_taps);
}

#endif
