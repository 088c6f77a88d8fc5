// SPDX-License-Identifier: Apache-2.0
// A host's depth, and normals if there are, as Gnomon's G-buffer. The includer has host_depth(pixel), and defines MOVES where there is motion:
// an output without a target makes validation warn.
#ifndef GNOMON_HOST_RECEIVE_GLSL
#define GNOMON_HOST_RECEIVE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/receiver.glsl"
#include "src/host/receive.shared.h"

layout(set = 0, binding = 1) uniform sampler2D normals;
#ifdef MOVES
layout(set = 0, binding = 2) uniform sampler2D motions;
layout(location = 2) out vec2 motion_out;
#endif
layout(set = 1, binding = 0, scalar) uniform Constants { ReceiveConstants c; };

layout(location = 0) out uvec2 normal_out;
layout(location = 1) out uint primitive_out;

vec2 ndc_of(ivec2 pixel) { return (vec2(pixel) + 0.5) / c.view.size * 2.0 - 1.0; }

float depth_at(ivec2 pixel)
{
    const float depth = host_depth(pixel);
    if (depth == c.background) return 0.0;
    // The difference is exact far away, where a depth that is not reversed has all of its digits just below 1.
    const vec4 p = vec4(ndc_of(pixel), depth - c.background, 1.0);
    // nothing is as far as the background's 0
    return clamp(dot(c.depth_row, p) / dot(c.w_row, p), 1e-30, 1.0);
}

vec3 position_at(ivec2 pixel, float depth) { return world_from_depth(c.view, vec2(pixel) + 0.5, depth); }

// The position one pixel along `step` minus the one here, from the side whose two pixels continue to this one: view depth is linear across
// a plane's picture (near / distance is), so that the side which lies on the same plane extrapolates to this pixel's depth.
vec3 along(ivec2 pixel, ivec2 step, float depth, vec3 p)
{
    const ivec2 size = ivec2(c.view.size);
    float least = 1e38;
    vec3 found = vec3(0.0);
    for (int side = -1; side <= 1; side += 2) {
        const ivec2 one = pixel + side * step, two = one + side * step;
        if (any(lessThan(one, ivec2(0))) || any(greaterThanEqual(one, size))) continue;
        const float near_one = depth_at(one);
        if (near_one == 0.0) continue;
        const bool both = all(greaterThanEqual(two, ivec2(0))) && all(lessThan(two, size));
        const float off = both ? abs(2.0 * near_one - depth_at(two) - depth) : abs(near_one - depth);
        if (off < least) least = off, found = float(side) * (position_at(one, near_one) - p);
    }
    return found;
}

vec3 read_normal(ivec2 pixel)
{
    vec4 n = texelFetch(normals, pixel, 0);
    if ((c.normals & 1u) != 0) n = 2.0 * n - 1.0;
    if ((c.normals & 2u) != 0) {
        n.z = 1.0 - abs(n.x) - abs(n.y);
        if (n.z < 0.0) n.xy = octahedral_wrap(n.xy);
    }
    return vec3(dot(c.normal_x.xyz, n.xyz), dot(c.normal_y.xyz, n.xyz), dot(c.normal_z.xyz, n.xyz));
}

void receive(ivec2 pixel)
{
    const float depth = depth_at(pixel);
    gl_FragDepth = depth;
#ifdef MOVES
    motion_out = texelFetch(motions, pixel, 0).xy;
#endif
    if (depth == 0.0) {
        normal_out = uvec2(0);
        primitive_out = 0xffffffffu;
        return;
    }
    const vec3 p = position_at(pixel, depth), eye = towards_eye(c.view, p);
    const vec3 given = c.normals == NORMALS_NONE ? vec3(0.0) : read_normal(pixel);
    vec3 n = (c.normals & NORMALS_GEOMETRIC) != 0 ? given : cross(along(pixel, ivec2(1, 0), depth, p), along(pixel, ivec2(0, 1), depth, p));
    // a surface one pixel wide, or seen edge-on, has no plane of its own here
    n = dot(n, n) > 0.0 ? normalize(n) : eye;
    if (dot(n, eye) < 0.0) n = -n;
    vec3 shading = dot(given, given) > 0.0 ? normalize(given) : n;
    if (dot(shading, n) < 0.0) shading = -shading;
    normal_out = uvec2(encode_normal(shading), encode_normal(n));
    primitive_out = 0xfffffffeu; // some triangle
}

#endif
