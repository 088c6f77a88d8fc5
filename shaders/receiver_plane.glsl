// SPDX-License-Identifier: Apache-2.0
// What each texel around a receiver is compared with. One depth for all of a wide kernel makes a tilted receiver shadow itself; its own
// plane, followed to every texel's centre, does not.
#ifndef GNOMON_RECEIVER_PLANE_GLSL
#define GNOMON_RECEIVER_PLANE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"
#include "shaders/light_map.glsl"

// Rasterisers snap vertices to 1/256 texel; with both ends of an edge, a plane's depth moves by 1/128 of its slope.
#define PLANE_SNAP (1.0 / 128.0)

// The depth to compare with at d texels from `at` is z + max(dot(slope, d), cone * |d|), of which one is 0 or both count; a warp bends the plane.
struct ReceiverPlane {
    vec2 at; // where the receiver falls, in texels
    float z; // stored depth there, with all margins
    vec2 slope; // change of stored depth from texel to texel
    float cone;
    vec2 bend; // of the plane, by a warp: slopes at d texels are divided by 1 + dot(bend, d)
};

// Change of stored depth by one metre of depth.
float stored_per_metre(LightMapLayer layer, float depth)
{
    const float range = layer.far - layer.near;
    return layer.perspective != 0 ? layer.near * layer.far / (range * depth * depth) : 1.0 / range;
}

// dz/du and dz/dv along the plane through p with normal n (unit). The map is projective, and takes planes to planes: the quotient of
// differentials at p holds all over the plane, for perspective layers too. It is what Isidoro (2006) takes from screen-space
// derivatives, which go wrong wherever 2 x 2 pixels see two surfaces. Planes that hold the light's ray give large finite numbers.
vec2 receiver_slope(LightMapLayer layer, vec3 p_world, vec3 n)
{
    vec3 t, b;
    orthonormal_basis(n, t, b);
    const vec4 h = layer.map_from_world * vec4(p_world, 1.0);
    const vec4 ht = layer.map_from_world * vec4(t, 0.0), hb = layer.map_from_world * vec4(b, 0.0);
    // d(h / w) = (dh w - h dw) / w^2; the powers of w cancel in the quotients
    vec3 x = ht.xyz * h.w - h.xyz * ht.w, y = hb.xyz * h.w - h.xyz * hb.w;
    if (layer.warped != 0) { // the stored depth is no row of the matrix; this is its first order at p
        const float scale = -h.w * h.w * stored_per_metre(layer, dot(layer.depth_plane, vec4(p_world, 1.0)));
        x.z = scale * dot(layer.depth_plane.xyz, t);
        y.z = scale * dot(layer.depth_plane.xyz, b);
    }
    const float det = x.x * y.y - x.y * y.x;
    return vec2(x.z * y.y - x.y * y.z, x.x * y.z - x.z * y.x) / (abs(det) < 1e-30 ? 1e-30 : det);
}

// Of the plane through p, whose depth a warp makes a quotient in u and v: at d texels it lies dot(slope, d) / (1 + dot(bend, d)) off. Depth and
// w are affine on the plane: what counts is the gradient of w's logarithm, less that of the depth's where stored depth is its inverse.
vec2 warp_bend(LightMapLayer layer, float size, vec3 p_world, vec3 n)
{
    if (layer.warped == 0) return vec2(0.0);
    vec3 t, b;
    orthonormal_basis(n, t, b);
    const vec4 h = layer.map_from_world * vec4(p_world, 1.0);
    const vec4 ht = layer.map_from_world * vec4(t, 0.0), hb = layer.map_from_world * vec4(b, 0.0);
    vec3 x = ht.xyw * h.w - h.xyw * ht.w, y = hb.xyw * h.w - h.xyw * hb.w;
    const float inverse = layer.perspective != 0 ? h.w * h.w / dot(layer.depth_plane, vec4(p_world, 1.0)) : 0.0;
    x.z = ht.w * h.w - inverse * dot(layer.depth_plane.xyz, t);
    y.z = hb.w * h.w - inverse * dot(layer.depth_plane.xyz, b);
    const float det = x.x * y.y - x.y * y.x;
    return vec2(x.z * y.y - x.y * y.z, x.x * y.z - x.z * y.x) / (-size * (abs(det) < 1e-30 ? 1e-30 : det));
}

// One depth for all texels.
ReceiverPlane flat_plane(LightMapLayer layer, float size, float depth_step, MapPoint m)
{
    return ReceiverPlane(m.uv * size, reference_depth(layer, m.depth, depth_step), vec2(0.0), 0.0, vec2(0.0));
}

// The slope of the plane through p in metres of depth a metre across, as the layer sees it: no longer than `limit`, which holds it where
// the light grazes. Beyond it a texel would reach past all casters.
vec2 receiver_tangent(LightMapLayer layer, float size, MapPoint m, vec3 p_world, vec3 n, float limit)
{
    const vec2 tangent
        = receiver_slope(layer, p_world, n) / (size * stored_per_metre(layer, m.depth) * m.texel);
    return tangent * min(1.0, limit / max(length(tangent), 1e-20));
}

// Burley's bias cone (2006): towards the light by `opening` metres of depth for each metre between the tap and the receiver, and by no
// less than the receiver's own slope, without which steep receivers shadow themselves.
ReceiverPlane cone_plane(LightMapLayer layer, float size, float depth_step, MapPoint m, vec3 p_world, vec3 n, float opening, float limit)
{
    ReceiverPlane r = flat_plane(layer, size, depth_step, m);
    const float texel = stored_per_metre(layer, m.depth) * max(m.texel.x, m.texel.y); // a texel's width as depth
    const float tangent = length(receiver_tangent(layer, size, m, p_world, n, limit));
    r.cone = max(opening, tangent) * texel;
    r.z += tangent * texel * PLANE_SNAP;
    return r;
}

// The receiver's own plane. Texels are compared at their centres, where the rasteriser sampled the caster, so that neither the kernel's
// width nor a nearest tap's half texel needs a bias. What is left is margin for two roundings: of vertices (PLANE_SNAP), and of the
// G-buffer's normal, off by up to 6e-5 rad: d tan(a) = (1 + tan^2 a) da, at the kernel's rim `radius` texels away.
ReceiverPlane receiver_plane(LightMapLayer layer, float size, float depth_step, MapPoint m, vec3 p_world, vec3 n, float radius, float limit)
{
    ReceiverPlane r = flat_plane(layer, size, depth_step, m);
    const vec2 texel = stored_per_metre(layer, m.depth) * m.texel;
    const vec2 tangent = receiver_tangent(layer, size, m, p_world, n, limit);
    r.slope = tangent * texel;
    r.z += dot(abs(r.slope), vec2(PLANE_SNAP)) + max(texel.x, texel.y) * 6e-5 * (1.0 + dot(tangent, tangent)) * radius;
    r.bend = warp_bend(layer, size, p_world, n);
    return r;
}

#endif
