// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "src/shadow/parts/volumes.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform usampler2D primitive_image;
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

layout(location = 0) out uvec4 receiver; // position from the eye, as bits, and primitive; where that is VOLUME_ASIDE, x is the visibility

void main()
{
    Receiver r;
    float visibility;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) {
        receiver = uvec4(floatBitsToUint(visibility), 0, 0, VOLUME_ASIDE);
        return;
    }
    // where a ray towards the light would begin, so that coincident casters do not darken it
    const vec3 p = (r.p_world - c.view.eye) + position_rounding(c.view, r) * (r.n_geometric + to_light(c.light, r.p_world).xyz);
    receiver = uvec4(floatBitsToUint(p), texelFetch(primitive_image, ivec2(gl_FragCoord.xy), 0).x);
}
