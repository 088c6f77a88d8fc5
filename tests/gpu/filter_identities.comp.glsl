// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/csm/csm.glsl"
#include "techniques/esm/esm.glsl"
#include "techniques/evsm/evsm.glsl"
#include "techniques/lvsm/lvsm.glsl"
#include "shaders/moments.glsl"
#include "techniques/power_cdf/power_cdf.glsl"
#include "tests/gpu/filter_identities.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { WindowCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { WindowResult results[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Extra { vec2 depths[]; }; // centred depth, weight
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

vec4 powers(float z) { return vec4(z, z * z, z * z * z, z * z * z * z); }

vec4 stored(vec4 v, int bits)
{
    const float steps = exp2(float(bits)) - 1.0;
    return bits == 0 ? v : round(v * steps) / steps;
}

float evsm(WindowCase w, bool both)
{
    vec4 mean = vec4(0.0);
    for (int i = 0; i < w.count; ++i) {
        const vec2 z = depths[w.first + i];
        const vec2 warps = exponential_warps(z.x, w.exponent, w.negative_exponent);
        mean += z.y * vec4(warps.x, warps.x * warps.x, warps.y, warps.y * warps.y);
    }
    return evsm_visibility(mean, w.t, w.exponent, w.negative_exponent, w.min_deviation, both);
}

float esm(WindowCase w, bool logarithm)
{
    float mean = logarithm ? -1e30 : 0.0;
    for (int i = 0; i < w.count; ++i) {
        const vec2 z = depths[w.first + i];
        const float value = esm_value(z.x, w.exponent, logarithm);
        const float a = value + log(z.y);
        mean = logarithm ? max(mean, a) + log(1.0 + exp(-abs(mean - a))) : mean + z.y * value;
    }
    return esm_exponential(mean, w.t, w.exponent, logarithm);
}

float csm(WindowCase w)
{
    const int groups = w.terms / 2;
    float sum = 0.5;
    for (int k = 0; k < groups; ++k) {
        vec4 mean = vec4(0.0);
        for (int i = 0; i < w.count; ++i) {
            const vec2 z = depths[w.first + i];
            mean += z.y * stored(0.5 + 0.5 * sines(phase_of(z.x), k), w.bits);
        }
        sum += fourier_step(2.0 * stored(mean, w.bits) - 1.0, phase_of(w.t), k, damping(k, 1.0 / float(w.terms), w.attenuation));
    }
    return sum;
}

float lvsm(WindowCase w)
{
    const float extent = 2.0 / float(w.layers);
    const int layer = clamp(int(floor((w.t + 1.0) / extent)), 0, w.layers - 1);
    const float front = -1.0 + extent * float(layer), back = front + extent;
    vec2 mean = vec2(0.0);
    for (int i = 0; i < w.count; ++i) {
        const vec2 z = depths[w.first + i];
        const float warped = layer_warp(z.x, front, back, w.overlap);
        mean += z.y * vec2(warped, warped * warped);
    }
    return layer_visibility(mean, w.t, front, back, w.overlap, w.min_deviation);
}

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= count) return;
    const WindowCase w = cases[index];
    vec4 b = vec4(0.0), q = vec4(0.0);
    vec2 range = vec2(1e30, -1e30);
    for (int i = 0; i < w.count; ++i) {
        const vec2 z = depths[w.first + i];
        b += z.y * powers(z.x);
        q += z.y * quantised_from_moments(powers(z.x));
        range = vec2(min(range.x, z.x), max(range.y, z.x));
    }
    WindowResult r;
    r.vsm = chebyshev(b.xy, w.t, w.min_deviation * w.min_deviation);
    r.evsm2 = evsm(w, false);
    r.evsm4 = evsm(w, true);
    r.msm = msm_visibility(b, w.t, w.moment_bias);
    r.msm_quantised = msm_visibility(moments_from_quantised(q), w.t, w.moment_bias);
    r.esm = min(esm(w, false), 1.0);
    r.esm_log = min(esm(w, true), 1.0);
    r.csm = csm(w);
    r.lvsm = lvsm(w);
    r.power = power_visibility(b.x, range.x, range.y, w.t, 0.0);
    r.moments = b;
    r.quantised = q;
    r.returned = moments_from_quantised(q);
    results[index] = r;
}
