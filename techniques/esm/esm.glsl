// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_ESM_GLSL
#define GNOMON_ESM_GLSL

// What a map holds of the centred depth t: exp(c t / 2), or its logarithm. c spans the depth range, which is two wide.
float esm_value(float t, float exponent, bool logarithm) { return logarithm ? 0.5 * exponent * t : exp(0.5 * exponent * t); }

// exp(c (z - t) / 2) from the mean of what the map holds: the logarithm's difference first, so that nothing overflows.
float esm_exponential(float value, float t, float exponent, bool logarithm)
{
    const float shift = 0.5 * exponent * t;
    return logarithm ? exp(min(value - shift, 80.0)) : value * exp(-shift);
}

#endif
