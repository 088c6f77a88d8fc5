// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/receiver.glsl"

// Depth and by how much it grows a pixel to the right and a pixel down, on the plane of the triangle that the pixel shows.
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform usampler2D primitive_image;
layout(set = 1, binding = 0, scalar) uniform Constants { View view; };

layout(location = 0) out vec4 surface;

float depth_at(ivec2 pixel) { return texelFetch(depth_image, pixel, 0).r; }

// Where a neighbour shows the same triangle, the difference to it is exact but for depth's own rounding.
bool same_triangle(ivec2 a, ivec2 b)
{
    return all(greaterThanEqual(b, ivec2(0))) && all(lessThan(b, ivec2(view.size)))
        && texelFetch(primitive_image, a, 0).r == texelFetch(primitive_image, b, 0).r;
}

float slope(ivec2 pixel, ivec2 step_across, float of_plane)
{
    if (same_triangle(pixel, pixel + step_across)) return depth_at(pixel + step_across) - depth_at(pixel);
    if (same_triangle(pixel, pixel - step_across)) return depth_at(pixel) - depth_at(pixel - step_across);
    return of_plane;
}

void main()
{
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const Receiver r = load_receiver(view, depth_image, normal_image, gl_FragCoord.xy);
    surface = vec4(0.0);
    if (r.background) return;
    // The receiver's plane over normalised device coordinates: depth is affine over it.
    const vec4 plane = vec4(r.n_geometric, -dot(r.n_geometric, r.p_world)) * view.world_from_clip;
    const vec2 of_plane = abs(plane.z) > 0.0 ? -plane.xy / plane.z * 2.0 / view.size : vec2(0.0);
    const float z = depth_at(pixel);
    // The farthest sample lies half a pixel away both ways: none comes to the eye's plane or beyond infinity.
    const vec2 slopes = vec2(slope(pixel, ivec2(1, 0), of_plane.x), slope(pixel, ivec2(0, 1), of_plane.y));
    surface = vec4(z, clamp(slopes, -0.5 * z, 0.5 * z), 0.0);
}
