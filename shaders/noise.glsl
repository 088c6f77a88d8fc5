// SPDX-License-Identifier: Apache-2.0
// Noise that is even over a few pixels: each pixel's value in [0,1), another one each frame, with the golden ratio between frames.
#ifndef GNOMON_NOISE_GLSL
#define GNOMON_NOISE_GLSL

#define ROTATE_NONE 0
#define ROTATE_BLUE_NOISE 1
#define ROTATE_INTERLEAVED_GRADIENT 2

// Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare": any 3 x 3 pixels hold near-even values.
float interleaved_gradient(ivec2 pixel, uint frame)
{
    return fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715))) + 0.61803399 * float(frame % 1024u));
}

// `noise` is shadow::parts::blue_noise.
float blue_noise(sampler2D noise, ivec2 pixel, uint frame)
{
    return fract(texelFetch(noise, pixel % textureSize(noise, 0), 0).r + 0.61803399 * float(frame % 1024u));
}

float pixel_noise(int rotation, sampler2D noise, ivec2 pixel, uint frame)
{
    if (rotation == ROTATE_NONE) return 0.0;
    return rotation == ROTATE_BLUE_NOISE ? blue_noise(noise, pixel, frame) : interleaved_gradient(pixel, frame);
}

// Turns a disk of taps, by another angle each pixel and frame.
mat2 tap_rotation(int rotation, sampler2D noise, ivec2 pixel, uint frame)
{
    if (rotation == ROTATE_NONE) return mat2(1.0);
    const float angle = 6.28318531 * pixel_noise(rotation, noise, pixel, frame);
    return mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
}

// Moves a square of taps, in [-1, 1]^2, around a torus: turning would take its corners out.
vec2 tap_shift(int rotation, sampler2D noise, ivec2 pixel, uint frame)
{
    return vec2(pixel_noise(rotation, noise, pixel, frame), pixel_noise(rotation, noise, pixel + ivec2(37, 17), frame));
}

vec2 shifted_tap(vec2 tap, vec2 shift) { return 2.0 * fract(0.5 + 0.5 * tap + shift) - 1.0; }

#endif
