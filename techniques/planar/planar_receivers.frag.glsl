// SPDX-License-Identifier: Apache-2.0
// Which plane each pixel lies on, and what it sees of the light before anything casts.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "techniques/planar/planar.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ReceiverConstants c; };

layout(location = 0) out float visibility;
layout(location = 1) out uint plane;

void main()
{
    Receiver r;
    const bool faces = find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility);
    if (faces) visibility = 1.0;
    plane = PLANAR_NONE;
    if (r.background) return;
    // The position comes from a float depth through an inverse matrix: off its plane by some millionths of its distance from the eye.
    const float distance = c.view.orthographic != 0 ? 0.0 : length(r.p_world - c.view.eye);
    const float tolerance = c.thickness + 3e-6 * distance;
    float nearest = tolerance;
    for (uint k = 0; k < c.plane_count; ++k) {
        const float off = abs(dot(c.planes[k], vec4(r.p_world, 1.0)));
        // one degree: a surface that only crosses the plane is not on it
        if (off > nearest || abs(dot(c.planes[k].xyz, r.n_geometric)) < 0.99985) continue;
        nearest = off;
        plane = k;
    }
    if (plane == PLANAR_NONE) return;
    // The plane knows better than a normal of 16 bits which side is seen.
    const bool lit_side = dot(c.planes[plane].xyz, r.n_geometric) > 0.0 && (c.edge_on >> plane & 1u) == 0;
    visibility = lit_side && light_reaches(c.light, r.p_world) ? 1.0 : 0.0;
    if (visibility == 0.0) plane = PLANAR_NONE;
}
