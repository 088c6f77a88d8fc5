// SPDX-License-Identifier: Apache-2.0
// Four moments of a window of depths: how they are stored, and the least shadow that they allow.
#ifndef GNOMON_MOMENTS_GLSL
#define GNOMON_MOMENTS_GLSL

// A basis of the even and of the odd moments in which 16-bit fixed point loses least (Peters and Klein 2015, section 3.3): each
// polynomial fills [0, 1] for t in [-1, 1], and the map's determinant is large.
const float sqrt3 = 1.7320508075688772;

vec4 quantised_from_moments(vec4 b)
{
    return vec4(1.5 * b.x - 2.0 * b.z + 0.5, 4.0 * (b.y - b.w), 0.5 * sqrt3 * b.x - 2.0 * sqrt3 / 9.0 * b.z + 0.5, 0.5 * (b.y + b.w));
}

vec4 moments_from_quantised(vec4 q)
{
    const vec2 odd = q.xz - 0.5;
    const float scale = 0.5 * sqrt3; // 1 / determinant (2 sqrt(3) / 3) of the odd half
    return vec4(scale * (2.0 * odd.y - 2.0 * sqrt3 / 9.0 * odd.x), q.w + 0.125 * q.y, scale * (1.5 * odd.y - 0.5 * sqrt3 * odd.x),
        q.w - 0.125 * q.y);
}

// Of all distributions of depth with the moments b = (E[z], E[z^2], E[z^3], E[z^4]), z in [-1, 1], the one with the least mass before
// t is t itself and two other depths (Peters and Klein 2015, algorithm 1). x: that mass, not a number where b says nothing; y: its integral
// of z - t, which the mean of b gives where both other depths are before t.
vec2 moments_before(vec4 b, float t, float bias)
{
    b = mix(b, vec4(0.0, 0.628, 0.0, 0.628), bias);
    // Cholesky factorisation of the Hankel matrix (1 b1 b2; b1 b2 b3; b2 b3 b4) and the solution of H x = (1, t, t^2)
    const float l21_d11 = b.z - b.x * b.y;
    const float d11 = b.y - b.x * b.x;
    const float square_variance = b.w - b.y * b.y;
    const float d22_d11 = square_variance * d11 - l21_d11 * l21_d11;
    const float inv_d11 = 1.0 / max(d11, 1e-12);
    const float l21 = l21_d11 * inv_d11;
    const float inv_d22 = d11 / max(d22_d11, 1e-20);
    vec3 x = vec3(1.0, t, t * t);
    x.y -= b.x;
    x.z -= b.y + l21 * x.y;
    x.y *= inv_d11;
    x.z *= inv_d22;
    x.y -= l21 * x.z;
    x.x -= dot(x.yz, b.xy);
    // The two other depths are the roots of x.x + x.y z + x.z z^2. Where t is one of only two depths, x.z vanishes and one root leaves for
    // infinity: the other one is taken without subtraction, and infinity is a million.
    x /= max(max(abs(x.x), abs(x.y)), abs(x.z));
    const float root = sqrt(max(x.y * x.y - 4.0 * x.x * x.z, 0.0));
    const float s = -0.5 * (x.y + (x.y < 0.0 ? -root : root));
    const float small = s == 0.0 ? 0.0 : x.x / s, large = s / (abs(x.z) < 1e-6 * abs(s) ? 1e-6 * abs(s) : x.z);
    const float z1 = min(small, large), z2 = max(small, large);
    if (z2 < t) return vec2(1.0 + (z1 * z2 - b.x * (z1 + z2) + b.y) / ((z2 - t) * (t - z1)), b.x - t);
    if (!(z1 < t)) return vec2(0.0);
    const float mass = (t * z2 - b.x * (t + z2) + b.y) / ((z2 - z1) * (t - z1));
    return vec2(mass, mass * (z1 - t));
}

// An upper bound of the lit fraction.
float msm_visibility(vec4 b, float t, float bias)
{
    const float mass = moments_before(b, t, bias).x;
    return isnan(mass) ? 1.0 : clamp(1.0 - mass, 0.0, 1.0);
}

#endif
