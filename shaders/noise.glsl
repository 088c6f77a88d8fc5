// SPDX-License-Identifier: Apache-2.0
// Noise that is even over a few pixels: each pixel's value in [0,1), another one each frame, with the golden ratio between frames.
#ifndef GNOMON_NOISE_GLSL
#define GNOMON_NOISE_GLSL

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

#endif
