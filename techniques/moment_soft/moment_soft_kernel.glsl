// SPDX-License-Identifier: Apache-2.0
// What four moments of a window's parts say about a receiver (Peters, Muenstermann, Wetzstein and Klein 2017). Depths are centred
// (shaders/filter_values.glsl), and x = z - t is one relative to the receiver: blockers have x < 0.
#ifndef GNOMON_MOMENT_SOFT_KERNEL_GLSL
#define GNOMON_MOMENT_SOFT_KERNEL_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/moments.glsl"

// Whoever includes this defines what shaders/window_grid.glsl wants, but for Means and the two structures, and says where depths come from.
#define Means vec4
vec4 moments_from_mean(vec4 stored);
float receiver_depth(vec2 at); // of the receiver's plane

struct KernelSettings {
    float moment_bias;
    float depth_bias; // centred
    vec2 tilt; // depth that the receiver is moved towards the light for each texel of a part's width and height
    bool centred; // parts count less towards the rim
};

// Sums over the parts.
struct Evidence {
    float area;
    vec2 blocked; // area of blockers, and its integral of x
};

#include "shaders/window_grid.glsl"

void weigh_part(inout Evidence e, KernelSettings k, vec4 mean, vec2 lo, vec2 hi, float area)
{
    // The tightest bound takes the near half of a part of a tilted plane for the blocker that it is, unless the receiver stands before it.
    const float t = receiver_depth(0.5 * (lo + hi)) - k.depth_bias - dot(k.tilt, hi - lo);
    const vec2 before = moments_before(moments_from_mean(mean), t, k.moment_bias);
    const bool sound = before.x > 0.0 && !isinf(before.x); // a number
    const float mass = sound ? min(before.x, 1.0) : 0.0;
    e.area += area;
    e.blocked += area * vec2(mass, sound ? clamp(before.y, -2.0 * mass, 0.0) : 0.0);
}

Evidence weigh_kernel(KernelSettings k, vec2 lo, vec2 hi)
{
    Evidence e = Evidence(0.0, vec2(0.0));
    add_grid(e, k, lo, hi);
    return e;
}

#endif
