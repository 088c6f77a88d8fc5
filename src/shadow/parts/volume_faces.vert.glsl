// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_sides.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Quads { VolumeQuad quads[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Caps { VolumeCap caps[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

layout(location = 0) flat out vec4 plane; // of the face, relative to the eye; 0 at infinity
layout(location = 1) flat out vec4 rim; // of a quad: the plane across it through its edge
layout(location = 2) flat out int weight;

invariant gl_Position; // faces that share an edge share its pixels

// A point, or where the light's ray through it ends.
vec4 clip_of(vec3 p, bool infinite)
{
    precise vec4 clip = c.view.clip_from_world * (infinite ? vec4(-light_from(c.light, p), 0.0) : vec4(p, 1.0));
    clip.z = 0.0; // neither near nor far plane cuts it; what lies behind the eye is cut all the same
    return clip;
}

vec4 plane_of(vec3 n, vec3 p)
{
    n /= max(length(n), 1e-30);
    return vec4(n, -dot(n, p - c.view.eye));
}

void main()
{
    const uint kind = gl_InstanceIndex;
    plane = rim = vec4(0.0);
    if (kind == VOLUME_QUADS) {
        const VolumeQuad q = quads[gl_VertexIndex / 6];
        const uint corner = uint[](0, 1, 2, 0, 2, 3)[gl_VertexIndex % 6];
        weight = q.weight;
        plane = plane_of(cross(q.to - q.from, light_from(c.light, q.from)), q.from);
        rim = plane_of(cross(plane.xyz, q.to - q.from), q.from);
        gl_Position = clip_of(corner == 0 || corner == 3 ? q.to : q.from, corner >= 2);
        return;
    }
    const VolumeCap cap = caps[gl_VertexIndex / 3];
    const uint k = gl_VertexIndex % 3;
    weight = cap.weight;
    if (kind == VOLUME_NEAR_CAPS) {
        plane = plane_of(cross(cap.b - cap.a, cap.c - cap.a), cap.a);
        gl_Position = clip_of(k == 0 ? cap.a : k == 1 ? cap.b : cap.c, false);
        if (c.edges == VOLUME_EDGES_CLOSED && weight < 0) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        return;
    }
    // seen from the other side
    gl_Position = clip_of(k == 0 ? cap.a : k == 1 ? cap.c : cap.b, true);
    if (c.edges == VOLUME_EDGES_CLOSED) {
        if (weight > 0) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        weight = -weight;
    }
}
