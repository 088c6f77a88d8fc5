// SPDX-License-Identifier: Apache-2.0
// Rays from receivers to points of a light. The shader that includes this defines `occluded`.
#ifndef GNOMON_LIGHT_RAYS_GLSL
#define GNOMON_LIGHT_RAYS_GLSL
#include "shaders/receiver.glsl"

bool occluded(vec3 origin, vec3 direction, float from, float to);

// Whether nothing stands before a light's point, as light_point gives it: its own plane neither. `error`: position_rounding. The ray
// also begins as far along its way: where another surface touches the receiver's (a table's leg the floor), rounding can put the
// point on the wrong side of that one.
bool sees_light_point(Receiver r, float error, vec4 point)
{
    const vec3 origin = r.p_world + r.n_geometric * error;
    const vec3 to_point = point.w == 0.0 ? point.xyz : point.xyz - r.p_world;
    if (dot(r.n_geometric, to_point) <= 0.0) return false;
    if (point.w == 0.0) return !occluded(origin, point.xyz, error, 1e30);
    const vec3 d = point.xyz - origin;
    const float length_d = length(d);
    return !occluded(origin, d / length_d, error, length_d);
}

#endif
