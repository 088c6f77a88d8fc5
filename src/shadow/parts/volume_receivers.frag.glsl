// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "src/shadow/parts/volumes.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2D decided_image;
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

layout(constant_id = 0) const bool some = false; // where decided_image is not negative, that is the visibility

// Position relative to the eye; and how far from it, along its surface, the point may lie that the rasteriser had in mind: corners are
// rounded to a 256th of a pixel. Where that is negative no light reaches it anyway, or nothing is there, and x is the visibility.
layout(location = 0) out vec4 receiver;

void main()
{
    Receiver r;
    float visibility = some ? texelFetch(decided_image, ivec2(gl_FragCoord.xy), 0).r : -1.0;
    if (visibility >= 0.0) {
        receiver = vec4(visibility, 0.0, 0.0, -1.0);
        return;
    }
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) {
        receiver = vec4(visibility, 0.0, 0.0, -1.0);
        return;
    }
    // where a ray towards the light would begin, so that coincident casters do not darken it
    const float rounding = position_rounding(c.view, r);
    const float facing = max(abs(dot(r.n_geometric, towards_eye(c.view, r.p_world))), 0.02);
    receiver.xyz = (r.p_world - c.view.eye) + rounding * (r.n_geometric + to_light(c.light, r.p_world).xyz);
    receiver.w = pixel_metres(c.view, r.p_world) / (256.0 * facing) + 2.0 * rounding;
}
