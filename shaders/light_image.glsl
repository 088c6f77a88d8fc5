// SPDX-License-Identifier: Apache-2.0
// The image of a rectangular light as a summed-area table (shadow/parts/light_image.h). Before the include: a buffer `vec4 light_image[]`.
#ifndef GNOMON_LIGHT_IMAGE_GLSL
#define GNOMON_LIGHT_IMAGE_GLSL

// What the light emits in the part of it below and left of p, in [-1, 1]^2 along half_u and half_v; 1 in each channel for all of it. Texels are
// constant, so between the corners of one the sum is bilinear: no error.
vec3 emitted_below(vec2 p)
{
    const ivec2 size = ivec2(light_image[0].xy);
    const vec2 at = clamp(0.5 * p + 0.5, 0.0, 1.0) * vec2(size);
    const ivec2 texel = min(ivec2(at), size - 1);
    const int i = 1 + texel.y * (size.x + 1) + texel.x;
    const vec2 f = at - vec2(texel);
    const vec3 bottom = mix(light_image[i].rgb, light_image[i + 1].rgb, f.x);
    const vec3 top = mix(light_image[i + size.x + 1].rgb, light_image[i + size.x + 2].rgb, f.x);
    return mix(bottom, top, f.y);
}

// In a rectangle (Crow 1984, "Summed-area tables for texture mapping").
vec3 emitted_within(vec2 lo, vec2 hi)
{
    return emitted_below(hi) - emitted_below(vec2(lo.x, hi.y)) - emitted_below(vec2(hi.x, lo.y)) + emitted_below(lo);
}

#define HORIZON_STRIPS 64

// Where a + b u + c v > 0. Strips across the less inclined axis end where the line crosses their middles: for a uniform light this is off by
// the corners that the square cuts off one strip, less than 1 / 8192 of the light.
vec3 emitted_above(float a, float b, float c)
{
    const bool upright = abs(c) >= abs(b);
    const float along = upright ? b : c, across = upright ? c : b;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < HORIZON_STRIPS; ++i) {
        const float lo = 2.0 * float(i) / HORIZON_STRIPS - 1.0, hi = lo + 2.0 / HORIZON_STRIPS;
        const float line = clamp(-(a + along * 0.5 * (lo + hi)) / across, -1.0, 1.0);
        const vec2 part = across > 0.0 ? vec2(line, 1.0) : vec2(-1.0, line);
        sum += upright ? emitted_within(vec2(lo, part.x), vec2(hi, part.y)) : emitted_within(vec2(part.x, lo), vec2(part.y, hi));
    }
    return sum;
}

#endif
