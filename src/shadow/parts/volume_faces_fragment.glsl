// SPDX-License-Identifier: Apache-2.0
// What a face of a volume adds to a pixel.
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volumes.shared.h"

layout(constant_id = 1) const bool COUNTED = false;

layout(set = 0, binding = 0, scalar) readonly buffer Quads { VolumeQuad quads[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Caps { VolumeCap caps[]; };
layout(set = 0, binding = 2) uniform sampler2D receivers;
layout(set = 0, binding = 3, scalar) buffer Work { VolumeWork work; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

layout(location = 0) flat in vec4 plane;
layout(location = 1) flat in vec4 rim;
layout(location = 2) flat in vec4 weight;

layout(location = 0) out vec4 change;

// Whether the eye's ray meets the face before the receiver. Not by interpolated depth, which is off by units in the last place of the
// face's largest, behind the eye for most: by the sides of the face's plane on which eye and receiver lie. Caps through the receiver
// and quads from an edge there are behind it: they are those of its own triangle, whose rim it may overstep.
bool crossed_before(vec4 receiver)
{
    const float eye = c.view.orthographic != 0 ? -dot(plane.xyz, c.view.forward) : plane.w;
    const float here = dot(plane.xyz, receiver.xyz) + plane.w;
    const bool touches = abs(here) <= receiver.w && abs(dot(rim.xyz, receiver.xyz) + rim.w) <= receiver.w;
    return (eye >= 0.0) != (here >= 0.0) && !touches;
}

void main()
{
    const vec4 receiver = texelFetch(receivers, ivec2(gl_FragCoord.xy), 0);
    if (COUNTED) atomicAdd(work.fragments, 1);
    change = vec4(0.0);
    if (receiver.w < 0.0 || crossed_before(receiver) != (c.count != VOLUME_ZFAIL)) discard;
    if (COUNTED) atomicAdd(work.updates, 1);
    change = gl_FrontFacing != (c.count == VOLUME_ZFAIL) ? weight : -weight;
}
