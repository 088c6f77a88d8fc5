// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_CSM_GLSL
#define GNOMON_CSM_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/fourier.glsl"

// Depths fill 0.95 of the wave's half period.
float phase_of(float centred) { return 3.14159265358979 * 0.95 * (0.5 + 0.5 * centred); }

// Against ringing, of the terms 2i + 1 and 2i + 2.
vec2 damping(int i, float per_term, float attenuation)
{
    const vec2 k = vec2(2 * i + 1, 2 * i + 2);
    return exp(-attenuation * k * k * per_term * per_term);
}

#endif
