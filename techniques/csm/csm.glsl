// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_CSM_GLSL
#define GNOMON_CSM_GLSL

// The step H(z - t) as a square wave's Fourier series (Annen et al. 2007, equation 7; the book's equation 5.20):
//   1/2 + 2 sum_k (cos(c_k t) sin(c_k z) - sin(c_k t) cos(c_k z)) / c_k,  c_k = pi (2k - 1),  z and t in [0, 1].
// The wave has period 2 and turns over again where |z - t| = 1: depths fill 0.95 of it.
float phase_of(float centred) { return 3.14159265358979 * 0.95 * (0.5 + 0.5 * centred); }

// sin and cos of the terms 2i + 1 and 2i + 2 (k counted from 1).
vec4 sines(float phase, int i)
{
    const vec2 angle = vec2(4 * i + 1, 4 * i + 3) * phase;
    return vec4(sin(angle.x), cos(angle.x), sin(angle.y), cos(angle.y));
}

// Those terms' part of the sum, from the means of their sines and cosines.
float fourier_step(vec4 means, float phase, int i, float per_term, float attenuation)
{
    const vec4 s = sines(phase, i);
    const vec2 k = vec2(2 * i + 1, 2 * i + 2);
    const vec2 c_k = 3.14159265358979 * (2.0 * k - 1.0);
    const vec2 damping = exp(-attenuation * k * k * per_term * per_term);
    const vec2 term = vec2(s.y * means.x - s.x * means.y, s.w * means.z - s.z * means.w);
    return dot(2.0 / c_k * damping, term);
}

#endif
