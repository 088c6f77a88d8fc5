// SPDX-License-Identifier: Apache-2.0
// What part of a light is hidden: bits for samples of it (shadow/parts/light_samples.h), or a sum of areas. Before the include: a buffer
// `uint light_samples[]` with the table, and a constant `words`, the number of words in a mask (2 or 8; 0 sums areas); a buffer
// `vec4 light_image[]` and a constant `textured`, false where the light has no image and the buffer is not read.
#ifndef GNOMON_LIGHT_SAMPLES_GLSL
#define GNOMON_LIGHT_SAMPLES_GLSL

#include "shaders/light_image.glsl"

#define LIGHT_SAMPLE_GRID 256

uint hidden_samples[8];
float hidden_area; // of 4, the square [-1, 1]^2
vec3 hidden_emission; // of 1, where areas are summed

// What every receiver begins with.
void hide_nothing()
{
    hidden_samples = uint[8](0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    hidden_area = 0.0;
    hidden_emission = vec3(0.0);
}

// The first border of the grid such that no sample beyond it lies below x.
int sample_border(float x) { return int(clamp(ceil(x * (0.5 * LIGHT_SAMPLE_GRID) + (0.5 * LIGHT_SAMPLE_GRID - 0.5)), 0.0, LIGHT_SAMPLE_GRID)); }

// The bits below `count` in word k.
uint bits_below(uint count, int k)
{
    const int n = int(count) - 32 * k;
    return n >= 32 ? ~0u : n <= 0 ? 0u : (1u << n) - 1u;
}

// Hides lo <= p < hi. Samples are sorted by x, so that those between two sides are a run of bits.
void hide_rectangle(vec2 lo, vec2 hi)
{
    if (words == 0) {
        const vec2 side = max(clamp(hi, -1.0, 1.0) - clamp(lo, -1.0, 1.0), 0.0);
        hidden_area += side.x * side.y;
        if (textured && side.x * side.y > 0.0) hidden_emission += emitted_within(lo, hi);
        return;
    }
    const uint first = light_samples[sample_border(lo.x)], end = light_samples[sample_border(hi.x)];
    const int bottom = sample_border(lo.y), top = sample_border(hi.y);
    if (end <= first || top <= bottom) return;
    const int below = LIGHT_SAMPLE_GRID + 1 + words * bottom, above = LIGHT_SAMPLE_GRID + 1 + words * top;
    for (int k = 0; k < words; ++k)
        hidden_samples[k] |= bits_below(end, k) & ~bits_below(first, k) & light_samples[above + k] & ~light_samples[below + k];
}

// Whether no further rectangle can change anything.
bool all_hidden()
{
    if (words == 0) return hidden_area >= 4.0;
    uint all_bits = ~0u;
    for (int k = 0; k < words; ++k) all_bits &= hidden_samples[k];
    return all_bits == ~0u;
}

float visible_part()
{
    if (words == 0) return max(0.0, 1.0 - 0.25 * hidden_area);
    int hidden = 0;
    for (int k = 0; k < words; ++k) hidden += bitCount(hidden_samples[k]);
    return 1.0 - float(hidden) / float(32 * words);
}

// The same in each channel of a light with an image.
vec3 visible_colors()
{
    if (words == 0) return max(vec3(0.0), 1.0 - hidden_emission);
    vec3 sum = vec3(0.0);
    const int first = int(light_image[0].z);
    for (int k = 0; k < words; ++k)
        for (uint left = ~hidden_samples[k]; left != 0u; left &= left - 1u) sum += light_image[first + 32 * k + findLSB(left)].rgb;
    return min(sum, vec3(1.0));
}

#endif
