// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_FOURIER_GLSL
#define GNOMON_FOURIER_GLSL

// The step H(z - t) as a square wave's Fourier series (Annen et al. 2007, equation 7; the book's equation 5.20):
//   1/2 + 2 sum_k (cos(c_k t) sin(c_k z) - sin(c_k t) cos(c_k z)) / c_k,  c_k = pi (2k - 1),  z and t in [0, 1].
// The wave has period 2 and turns over again where |z - t| = 1. A phase is pi z.

// sin and cos of the terms 2i + 1 and 2i + 2 (k counted from 1).
vec4 sines(float phase, int i)
{
    const vec2 angle = vec2(4 * i + 1, 4 * i + 3) * phase;
    return vec4(sin(angle.x), cos(angle.x), sin(angle.y), cos(angle.y));
}

// Those terms' part of the sum, from the means of their sines and cosines, each term by its damping.
float fourier_step(vec4 means, float phase, int i, vec2 damping)
{
    const vec4 s = sines(phase, i);
    const vec2 c_k = 3.14159265358979 * vec2(4 * i + 1, 4 * i + 3);
    const vec2 term = vec2(s.y * means.x - s.x * means.y, s.w * means.z - s.z * means.w);
    return dot(2.0 / c_k * damping, term);
}

#endif
