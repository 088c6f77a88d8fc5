// SPDX-License-Identifier: Apache-2.0
// What a Fourier series says about a window's depths before a receiver at depth t (Annen et al. 2008, "Real-time, all-frequency shadows in
// dynamic scenes"). Depths run from -1 to 1 (techniques/cssm/cssm_depth.glsl).
#ifndef GNOMON_CSSM_KERNEL_GLSL
#define GNOMON_CSSM_KERNEL_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/fourier.glsl"
#include "techniques/cssm/cssm_depth.glsl"

// Whoever includes this gives means over a window, texels: of the sines and cosines of two terms (shaders/fourier.glsl), of the same times
// depth, of depth.
vec4 mean_waves(int i, vec2 lo, vec2 hi);
vec4 mean_depth_waves(int i, vec2 lo, vec2 hi);
float mean_depth(vec2 lo, vec2 hi);

float receiver_phase(Series s, float t) { return wave_phase(s, t) - 3.14159265358979 * s.shift; }

// The window's lit fraction before it is cut to [0, 1]: the mean of the scaled series of every texel.
float lit_series(Series s, float t, vec2 lo, vec2 hi)
{
    const float phase = receiver_phase(s, t);
    float sum = 0.0;
    for (int i = 0; i < s.groups; ++i) sum += fourier_step(mean_waves(i, lo, hi), phase, i, vec2(1.0));
    return 0.5 + s.scale * sum;
}

// What that is where all depths are z.
float lit_level(Series s, float t, float z)
{
    float sum = 0.0;
    for (int i = 0; i < s.groups; ++i) sum += fourier_step(sines(wave_phase(s, z), i), receiver_phase(s, t), i, vec2(1.0));
    return 0.5 + s.scale * sum;
}

// The lit fraction of a window of two planes: the lower, the receiver's, counts as exactly 1 and the upper as its level, which is not 0 near
// the receiver. Next to it there is nothing left to divide by.
float above_level(float lit, float level)
{
    level = min(level, 0.98);
    return clamp((lit - level) / (1.0 - level), 0.0, 1.0);
}

// The blocked fraction, and the blockers' mean depth less t: with b(z) = 1 - the series, E[b z] / E[b] (Dong 2011, equation 5.8). Both have the same scale
// and shift: with the plain series, 1/2 at its own depth, a receiver counts as half a blocker of its own.
vec2 blocker_series(Series s, float t, vec2 lo, vec2 hi, float least)
{
    const float phase = receiver_phase(s, t);
    const float blocked = 1.0 - lit_series(s, t, lo, hi);
    if (blocked <= max(least, 1e-6)) return vec2(0.0);
    const float mean = mean_depth(lo, hi);
    float sum = 0.0;
    for (int i = 0; i < s.groups; ++i) sum += fourier_step(mean_depth_waves(i, lo, hi), phase, i, vec2(1.0));
    return vec2(blocked, (0.5 * mean - s.scale * sum) / blocked - t);
}

#endif
