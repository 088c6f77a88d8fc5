// SPDX-License-Identifier: Apache-2.0
// The receiver: what the G-buffer says about a pixel.
#ifndef GNOMON_RECEIVER_GLSL
#define GNOMON_RECEIVER_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.shared.h"
#include "shaders/octahedral.glsl"

struct Receiver {
    vec3 p_world;
    vec3 n_geometric; // unit, world, on the eye's side
    vec3 n_shading;
    bool background;
};

vec3 world_from_depth(View view, vec2 pixel, float depth)
{
    const vec2 ndc = pixel / view.size * 2.0 - 1.0;
    const vec4 p = view.world_from_clip * vec4(ndc, depth, 1.0);
    return p.xyz / p.w;
}

// `pixel` is gl_FragCoord.xy (centres at +0.5).
Receiver load_receiver(View view, sampler2D depth_image, usampler2D normal_image, vec2 pixel)
{
    Receiver r;
    const float depth = texelFetch(depth_image, ivec2(pixel), 0).r;
    r.background = depth == 0.0;
    r.p_world = world_from_depth(view, pixel, depth);
    const uvec2 n = texelFetch(normal_image, ivec2(pixel), 0).rg;
    r.n_shading = decode_normal(n.x);
    r.n_geometric = decode_normal(n.y);
    return r;
}

// The receiver's position comes from a depth image through an inverse matrix, so it lies off its triangle by a few units in the
// last place of the eye's distance and of its own coordinates. Moving off the plane by more than that keeps the segment open
// at the receiver's end: neither its own triangle nor its neighbours in the plane block it. (By the scene's extent instead, the
// offset under a mountain range was 6 mm and let light in below a roof.)
float position_rounding(View view, Receiver r)
{
    const vec3 a = abs(r.p_world);
    return 2.5e-6 * (max(a.x, max(a.y, a.z)) + distance(view.eye, r.p_world));
}

// Where the ray of another pixel meets the receiver's plane, in the plane's first-order approximation at p: planes seen edge-on would
// put it at the horizon or behind the eye.
vec3 beside_on_plane(View view, vec3 p_world, vec3 n, vec2 pixel_from, vec2 pixel_to)
{
    const vec4 a = view.world_from_clip * vec4(pixel_from / view.size * 2.0 - 1.0, 1.0, 1.0);
    const vec4 b = view.world_from_clip * vec4(pixel_to / view.size * 2.0 - 1.0, 1.0, 1.0);
    // both on the near plane: their difference, scaled out to p, is the step across the view
    const vec3 near_a = a.xyz / a.w, near_b = b.xyz / b.w;
    const float scale = view.orthographic != 0 ? 1.0 : dot(p_world - view.eye, view.forward) / max(dot(near_a - view.eye, view.forward), 1e-20);
    const vec3 step_across = (near_b - near_a) * scale;
    const vec3 ray = view.orthographic != 0 ? view.forward : normalize(p_world - view.eye);
    const float facing = dot(n, ray);
    return p_world + step_across - ray * (dot(n, step_across) / (abs(facing) < 0.02 ? (facing < 0.0 ? -0.02 : 0.02) : facing));
}

// Unit vector from the eye's picture towards the viewer.
vec3 towards_eye(View view, vec3 p_world) { return view.orthographic != 0 ? -view.forward : normalize(view.eye - p_world); }

// Width of a pixel at p, in metres, across the viewing direction.
float pixel_metres(View view, vec3 p_world) { return 2.0 * view.pixel_radius * (view.orthographic != 0 ? 1.0 : dot(p_world - view.eye, view.forward)); }

#endif
