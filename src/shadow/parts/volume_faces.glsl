// SPDX-License-Identifier: Apache-2.0
// Vertices of a volume's faces. CLIPPED: only beyond the near plane, and in a run of the picture's bands.
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_sides.glsl"
#include "src/shadow/parts/volume_weights.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Quads { VolumeQuad quads[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Caps { VolumeCap caps[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Weights { ivec4 weights[]; }; // by slot
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

layout(location = 0) flat out vec4 plane; // of the face, relative to the eye; 0 at infinity
layout(location = 1) flat out vec4 rim; // of a quad: the plane across it through its edge
layout(location = 2) flat out vec4 weight;

invariant gl_Position; // faces that share an edge share its pixels
#ifdef CLIPPED
layout(set = 0, binding = 5, scalar) readonly buffer SlotBands { uint slot_bands[]; };
out float gl_ClipDistance[3];
#endif

#ifdef CLIPPED
// Beyond the near plane, and between the ends of the bands in which the volume may darken something.
void clip_face(vec4 p, uint slot)
{
    const vec4 relative = vec4(p.xyz - p.w * c.view.eye, p.w);
    gl_ClipDistance[0] = c.count == VOLUME_ZP_PLUS ? dot(c.view.forward, relative.xyz) - c.view.near * p.w : 1.0;
    gl_ClipDistance[1] = gl_ClipDistance[2] = 1.0;
    if (c.bands.count == 0) return;
    const uint bands = slot_bands[slot], last = uint(findMSB(bands)), first = uint(findLSB(bands));
    if (first > 0) gl_ClipDistance[1] = dot(c.bands.planes[first], p);
    if (last + 1 < c.bands.count) gl_ClipDistance[2] = -dot(c.bands.planes[last + 1], p);
}
#endif

layout(constant_id = 2) const bool BY_DEPTH = false;

const vec4 nowhere = vec4(2.0, 2.0, 0.0, 1.0);

// A point, or where the light's ray through it ends.
vec4 clip_of(vec3 point, bool infinite, uint slot)
{
    precise const vec4 p = infinite ? vec4(-light_from(c.light, point), 0.0) : vec4(point, 1.0);
    precise vec4 clip = c.view.clip_from_world * p;
    if (!BY_DEPTH) clip.z = 0.0; // neither near nor far plane cuts it; what lies behind the eye is cut all the same
#ifdef CLIPPED
    clip_face(p, slot);
#endif
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
        weight = weight_of(weights[q.slot], q.weight);
        plane = plane_of(cross(q.to - q.from, light_from(c.light, q.from)), q.from);
        rim = plane_of(cross(plane.xyz, q.to - q.from), q.from);
        gl_Position = plane.xyz == vec3(0.0) || c.along_view != 0 ? nowhere : clip_of(corner == 0 || corner == 3 ? q.to : q.from, corner >= 2, q.slot);
        return;
    }
    const VolumeCap cap = caps[gl_VertexIndex / 3];
    const uint k = gl_VertexIndex % 3;
    const bool far = kind == VOLUME_FAR_CAPS;
    // of a closed mesh the light sees the near ends, and does not see the far ones
    const bool drawn = c.edges != VOLUME_EDGES_CLOSED || (cap.weight > 0) != far;
    weight = weight_of(weights[cap.slot], abs(cap.weight));
    if (!far) plane = plane_of(cross(cap.b - cap.a, cap.c - cap.a), cap.a);
    const vec3 p = k == 0 ? cap.a : (k == 1) != far ? cap.b : cap.c; // the far end is seen from the other side
    gl_Position = drawn ? clip_of(p, far && c.along_view == 0, cap.slot) : nowhere;
}
