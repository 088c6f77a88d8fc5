// SPDX-License-Identifier: Apache-2.0
// What two moments of a box kernel's depths, or of its parts', say about a receiver (Dong and Yang 2010, "Variance soft shadow mapping").
// Depths are centred (shaders/filter_values.glsl) and taken relative to the receiver's plane, x = z - t: blockers have x < 0. The plane is
// followed from part to part, so that a tilted receiver does not look like one half in front of the other.
#ifndef GNOMON_VSSM_KERNEL_GLSL
#define GNOMON_VSSM_KERNEL_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/chebyshev.glsl"
#include "techniques/vssm/vssm.shared.h"

// Whoever includes this defines what shaders/window_grid.glsl wants, but for its types, and says where depths come from.
#define Means vec2
vec2 window_moments(vec2 lo, vec2 hi); // means of z and z^2 over a window, texels
vec2 moments_from_mean(vec2 stored); // z and z^2 from the mean of stored values
float texel_depth(ivec2 texel);
float receiver_depth(vec2 at); // of the receiver's plane

struct KernelSettings {
    float flat_variance; // below it a part is one surface
    float min_variance;
    vec2 slope; // centred depth that the receiver's plane gains from texel to texel
    int height; // of the quad-tree
    bool per_cell;
    bool centred; // parts of the grid count less towards the rim
};

// Sums over the parts of a kernel whose areas add up to 1.
struct Evidence {
    float lit; // area without blockers
    vec3 bounded; // parts whose mean is nearer than the receiver: area, area x, area x^2
    float dark; // area that their own bounds leave dark
    vec3 compared; // parts of which texels were compared: area, blocked area, sum of blocked area x
};

Evidence no_evidence() { return Evidence(0.0, vec3(0.0), 0.0, vec3(0.0)); }

// Means of x and x^2 over a part, from those of z and z^2. Along the part the plane stays at its middle's depth.
vec2 relative_moments(vec2 m, vec2 lo, vec2 hi)
{
    const float t = receiver_depth(0.5 * (lo + hi));
    return vec2(m.x - t, m.y + t * (t - 2.0 * m.x));
}

vec2 part_moments(vec2 lo, vec2 hi) { return relative_moments(window_moments(lo, hi), lo, hi); }

// Four texels, one for each quarter of the part, at their own places on the plane: blocked share, and sum of x.
vec2 compare_quarters(vec2 lo, vec2 hi)
{
    vec2 blocked = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 texel = ivec2(floor(mix(lo, hi, 0.25 + 0.5 * vec2(i & 1, i >> 1))));
        const float x = texel_depth(texel) - receiver_depth(vec2(texel) + 0.5);
        if (x < 0.0) blocked += 0.25 * vec2(1.0, x);
    }
    return blocked;
}

// Counts a part of the kernel by its moments, or returns true where they do not suffice. A mean behind the receiver says nothing
// (Chebyshev's bound is one-sided) unless all depths are alike; `divisible` parts have to be of one depth in front of it, too.
bool inconclusive(inout Evidence e, KernelSettings k, vec2 m, vec2 extent, float area, bool divisible)
{
    const float variance = m.y - m.x * m.x;
    // a plane that falls by s over a part has a variance of s^2 / 12; texels at the rim count as wholes
    const vec2 across = k.slope * (extent + 1.0);
    const float own = dot(across, across) / 12.0;
    if (m.x >= 0.0) {
        if (variance < k.flat_variance + own) {
            e.lit += area;
            return false;
        }
        return true;
    }
    // Before steep planes blockers vary by less than the plane. Half its deviation: with all of it undivided umbrae are lit on `balls`, with
    // none of it parts that the plane hides are on `colonnade`.
    if (divisible && k.per_cell && variance >= k.flat_variance + 0.25 * own) return true;
    e.bounded += area * vec3(1.0, m);
    e.dark += area * (1.0 - chebyshev(m, 0.0, k.min_variance));
    return false;
}

bool wants_division(inout Evidence e, KernelSettings k, vec2 lo, vec2 hi, float area, bool divisible)
{
    const bool open = inconclusive(e, k, part_moments(lo, hi), hi - lo, area, divisible);
    if (open && !divisible) e.compared += area * vec3(1.0, compare_quarters(lo, hi));
    return open && divisible;
}

#include "shaders/window_grid.glsl"

void weigh_part(inout Evidence e, KernelSettings k, vec2 mean, vec2 lo, vec2 hi, float area)
{
    const bool open = inconclusive(e, k, relative_moments(moments_from_mean(mean), lo, hi), hi - lo, area, false);
    if (open) e.compared += area * vec3(1.0, compare_quarters(lo, hi));
}

// The place of a node among those of its level, from its Morton code: x in the even bits, y in the odd ones.
ivec2 morton_place(int code)
{
    ivec2 place = ivec2(0);
    for (int i = 0; i < 4; ++i) place |= ((ivec2(code, code >> 1) >> i) & (1 << i));
    return place;
}

// A full quad-tree in pre-order without a stack: a node's first child is 4 code; after the last of four siblings comes the parent's
// next one.
void add_tree(inout Evidence e, KernelSettings k, vec2 lo, vec2 size)
{
    const int height = clamp(int(ceil(log2(max(max(size.x, size.y), 1.0)))), 1, k.height);
    int level = 1, code = 0;
    while (level > 0) {
        const float share = exp2(-float(level));
        const vec2 at = lo + size * share * vec2(morton_place(code));
        if (wants_division(e, k, at, at + size * share, share * share, level < height)) {
            code *= 4;
            ++level;
            continue;
        }
        ++code;
        while ((code & 3) == 0 && level > 0) {
            code >>= 2;
            --level;
        }
    }
}

Evidence weigh_kernel(KernelSettings k, vec2 lo, vec2 hi, int subdivision)
{
    Evidence e = no_evidence();
    if (subdivision == SUBDIVIDE_NONE) {
        const vec2 m = part_moments(lo, hi);
        if (m.x >= 0.0) e.lit = 1.0;
        else {
            e.bounded = vec3(1.0, m);
            e.dark = 1.0 - chebyshev(m, 0.0, k.min_variance);
        }
        return e;
    }
    if (!wants_division(e, k, lo, hi, 1.0, true)) return e;
    if (subdivision == SUBDIVIDE_UNIFORM) add_grid(e, k, lo, hi);
    else add_tree(e, k, lo, hi - lo);
    return e;
}

// Dark area of the bounded parts: of all of them as one window, or the sum of their own. The bound is concave in the moments, so that
// the sum is never smaller.
float bounded_dark(Evidence e, KernelSettings k)
{
    if (k.per_cell || e.bounded.x <= 0.0) return e.dark;
    return e.bounded.x * (1.0 - chebyshev(e.bounded.yz / e.bounded.x, 0.0, k.min_variance));
}

// Blocked area and the mean x of the blockers. With all that is not blocked taken to lie at the receiver's depth, the mean over a
// window is (1 - P) times the mean over its blockers (Dong 2011, equation 7.4), P being the lit fraction: with
// x, z_occ = (mu - P t) / (1 - P) is mu / (1 - P).
vec2 kernel_blocker(Evidence e, KernelSettings k)
{
    const float area = bounded_dark(e, k) + e.compared.y;
    return vec2(area, area > 0.0 ? (e.bounded.y + e.compared.z) / area : 0.0);
}

float kernel_visibility(Evidence e, KernelSettings k, float bleed_reduction)
{
    const float lit_share = e.bounded.x > 0.0 ? 1.0 - bounded_dark(e, k) / e.bounded.x : 0.0;
    return clamp(e.lit + e.bounded.x * reduce_bleeding(lit_share, bleed_reduction) + e.compared.x - e.compared.y, 0.0, 1.0);
}

#endif
