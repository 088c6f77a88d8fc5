// SPDX-License-Identifier: Apache-2.0
// Depth layers of one light, whatever their layout. Depth is reversed: stored 1 nearest the light, 0 = nothing there.
// Functions take one LightMapLayer and not the whole block: a struct passed by value with an array inside becomes indexed private
// memory, which lavapipe pays for at every pixel.
#ifndef GNOMON_LIGHT_MAP_GLSL
#define GNOMON_LIGHT_MAP_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_map.shared.h"

struct MapPoint {
    vec2 uv; // [0,1], v down
    float z; // reversed stored depth
    float depth; // linear, metres along the layer's axis
    bool inside; // in front of the layer's eye and within its rim
    vec2 texel; // metres, across the layer's axis, that a step of one texel in u and in v takes here
};

// Cube faces in the order +x -x +y -y +z -z of the cube's axes: the major one of p - centre.
int select_cube_layer(vec3 centre, mat3 axes, vec3 p_world)
{
    const vec3 d = (p_world - centre) * axes, a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0.0 ? 2 : 3;
    return d.z >= 0.0 ? 4 : 5;
}

// A tetrahedron's faces look along (1, 1, 1), (1, -1, -1), (-1, 1, -1) and (-1, -1, 1): the one most along p - centre.
int select_tetrahedron_layer(vec3 centre, mat3 axes, vec3 p_world)
{
    const vec3 d = (p_world - centre) * axes;
    const vec4 along = vec4(d.x + d.y + d.z, d.x - d.y - d.z, -d.x + d.y - d.z, -d.x - d.y + d.z);
    const float most = max(max(along.x, along.y), max(along.z, along.w));
    if (along.x == most) return 0;
    if (along.y == most) return 1;
    return along.z == most ? 2 : 3;
}

// Cascades lie one behind another along the view's axis: the number of those that end before p.
int select_cascade(vec3 centre, mat3 axes, vec4 splits[2], vec3 p_world)
{
    const vec4 depth = vec4(dot(p_world - centre, axes[2]));
    const vec4 ended = vec4(greaterThan(depth, splits[0])) + vec4(greaterThan(depth, splits[1]));
    return int(dot(ended, vec4(1.0)));
}

// Two paraboloids, each for the half of all directions on its side: the first looks along -y.
int select_paraboloid_layer(vec3 centre, mat3 axes, vec3 p_world) { return dot(p_world - centre, axes[1]) <= 0.0 ? 0 : 1; }

int select_layer(uint layout_kind, vec3 centre, mat3 axes, vec4 splits[2], vec3 p_world)
{
    if (layout_kind == LIGHT_MAP_SINGLE) return 0;
    if (layout_kind == LIGHT_MAP_DUAL_PARABOLOID) return select_paraboloid_layer(centre, axes, p_world);
    if (layout_kind == LIGHT_MAP_TETRAHEDRON) return select_tetrahedron_layer(centre, axes, p_world);
    return layout_kind == LIGHT_MAP_CUBE ? select_cube_layer(centre, axes, p_world) : select_cascade(centre, axes, splits, p_world);
}

// A layer as it is read around p. Of a paraboloid, whose map is no projection, this is the warped layer that is tangent to it at p: position,
// depth (there the distance from the light), texels' widths and receivers' slopes are right, to first order around p. All others are themselves.
// A paraboloid's map_from_world gives (s x, -s y, z, s) in its axes, and uv - 1/2 = s (x, -y) / (|p| + z) (Heidrich, Seidel 1998).
LightMapLayer layer_at(LightMapLayer layer, vec3 p_world)
{
    if (layer.warped != 2) return layer;
    const mat4 m = layer.map_from_world;
    const vec4 h = m * vec4(p_world, 1.0);
    const vec3 local = vec3(h.xy / h.w, h.z);
    const float distance = max(length(local), 1e-20), ahead = max(distance + local.z, 1e-6 * distance);
    const vec3 rows[3] = vec3[3](vec3(m[0][0], m[1][0], m[2][0]), vec3(m[0][1], m[1][1], m[2][1]), vec3(m[0][2], m[1][2], m[2][2]));
    const vec3 direction = (rows[0] * local.x + rows[1] * local.y) / h.w / distance + rows[2] * (local.z / distance);
    layer.depth_plane = vec4(direction, distance - dot(direction, p_world));
    for (int k = 0; k < 2; ++k) {
        const float uv = 0.5 + h[k] / ahead;
        const vec3 gradient = (rows[k] - (h[k] / ahead) * (direction + rows[2])) / ahead;
        const vec4 row = uv * layer.depth_plane + distance * vec4(gradient, -dot(gradient, p_world));
        for (int i = 0; i < 4; ++i) layer.map_from_world[i][k] = row[i];
    }
    for (int i = 0; i < 4; ++i) layer.map_from_world[i][3] = layer.depth_plane[i];
    layer.warped = 1;
    return layer;
}

// The layers that hold p: `first` alone, or in the band at a cascade's end also the one after it.
struct Layers {
    int first;
    float next; // share of the second; 0: there is none
};

Layers select_layers(uint layout_kind, vec3 centre, mat3 axes, vec4 splits[2], vec4 bands[2], vec3 p_world)
{
    Layers layers = Layers(select_layer(layout_kind, centre, axes, splits, p_world), 0.0);
    if (layout_kind != LIGHT_MAP_CASCADES) return layers;
    const int i = layers.first >> 2, k = layers.first & 3;
    const float depth = dot(p_world - centre, axes[2]);
    if (depth > bands[i][k]) layers.next = min((depth - bands[i][k]) / (splits[i][k] - bands[i][k]), 1.0);
    return layers;
}

// For a loop over both, which leaves out the second outside of bands.
int count_of(Layers layers) { return layers.next > 0.0 ? 2 : 1; }
float share_of(Layers layers, int i) { return i == 0 ? 1.0 - layers.next : layers.next; }

float stored_from_depth(LightMapLayer layer, float depth)
{
    // perspective: z w = near far / (far - near) - depth near / (far - near), w = depth
    const float scale = layer.near / (layer.far - layer.near);
    if (layer.perspective != 0) return scale * (layer.far / max(depth, 1e-20) - 1.0);
    return (layer.far - depth) / (layer.far - layer.near);
}

// What rounding may take of a stored depth. Perspective depth keeps its relative precision; affine depth is off by units in the last place
// of the range: at the far end, under an overhead sun, a floor was striped where the margin shrank with z.
float stored_rounding(LightMapLayer layer, float z) { return 4e-6 * max(z, layer.perspective != 0 ? 0.0 : 0.25); }

// What a receiver compares with: its stored depth plus what rounding may take. Surfaces across the light's axis have no slope for a
// bias to scale with: without this margin half of a floor right below a point light is acne, and with 6e-7 lavapipe, which
// interpolates the depth of a large clipped triangle with an error of several units in the last place, still shows stripes.
float reference_depth(LightMapLayer layer, float depth, float depth_step)
{
    const float z = max(0.0, stored_from_depth(layer, depth));
    return z + max(depth_step, stored_rounding(layer, z));
}

float depth_from_stored(LightMapLayer layer, float z)
{
    if (layer.perspective != 0) return layer.near * layer.far / (z * (layer.far - layer.near) + layer.near);
    return layer.far - z * (layer.far - layer.near);
}

// Linear depth on [-1, 1]: near to far plane.
float centred_from_depth(LightMapLayer layer, float depth) { return 2.0 * (depth - layer.near) / (layer.far - layer.near) - 1.0; }

// The gradient of u (k = 0) or v in world space, times w. Across the light's ray, along which neither changes.
vec3 gradient_of_uv(LightMapLayer layer, int k, vec2 uv)
{
    const mat4 m = layer.map_from_world;
    return vec3(m[0][k], m[1][k], m[2][k]) - uv[k] * vec3(m[0][3], m[1][3], m[2][3]);
}

vec3 across(LightMapLayer layer, vec3 v) { return v - dot(v, layer.depth_plane.xyz) * layer.depth_plane.xyz; }

MapPoint project(LightMapLayer layer, vec3 p_world)
{
    MapPoint m;
    const vec4 h = layer.map_from_world * vec4(p_world, 1.0);
    m.uv = h.xy / h.w;
    m.depth = dot(layer.depth_plane, vec4(p_world, 1.0));
    m.z = layer.warped != 0 ? stored_from_depth(layer, m.depth) : h.z / h.w;
    if (layer.warped != 0)
        for (int k = 0; k < 2; ++k) m.texel[k] = layer.texel_uv * h.w / max(length(across(layer, gradient_of_uv(layer, k, m.uv))), 1e-20);
    else m.texel = vec2(layer.texel_metres * (layer.perspective != 0 ? m.depth : 1.0));
    m.inside = h.w > 0.0 && all(greaterThanEqual(m.uv, vec2(0.0))) && all(lessThanEqual(m.uv, vec2(1.0)));
    return m;
}

// The point of the light's ray through `uv` at that linear depth: where the planes of one u, of one v and of the depth meet.
vec3 world_from_map(LightMapLayer layer, vec2 uv, float depth)
{
    const mat4 rows = transpose(layer.map_from_world);
    const vec4 a = rows[0] - uv.x * rows[3], b = rows[1] - uv.y * rows[3], d = layer.depth_plane;
    const vec3 bd = cross(b.xyz, d.xyz), da = cross(d.xyz, a.xyz), ab = cross(a.xyz, b.xyz);
    return (-a.w * bd - b.w * da + (depth - d.w) * ab) / dot(a.xyz, bd);
}

float fetch_depth(sampler2DArray map, int layer_index, ivec2 texel)
{
    return texelFetch(map, ivec3(texel, layer_index), 0).r;
}

// 1 where the stored occluder is not nearer than `z`: the hardware's compare, filtered if the sampler is.
float compare_depth(sampler2DArrayShadow map, int layer_index, vec2 uv, float z)
{
    return texture(map, vec4(uv, float(layer_index), z));
}

// Percentage-closer filtering over n x n taps one texel apart around `at` (in texels). Bilinear taps overlap, so that their sum is
// one weight a texel on n + 1 texels a side: 1 inside, the fraction and its complement at the ends (exact, where the hardware's
// weights have 8 bits). Gathers then compare four texels each: 3 x 3 taps take 4 gathers instead of 9 filtered compares.
// Nearest taps are the same sum with the fraction rounded.
float box_filter(sampler2DArrayShadow map, int layer_index, vec2 at, float z, int n, bool bilinear)
{
    const vec2 corner = at - 0.5 * float(n);
    const vec2 first = floor(corner);
    const vec2 f = bilinear ? corner - first : step(0.5, corner - first);
    const vec2 texel = 1.0 / vec2(textureSize(map, 0).xy);
    float sum = 0.0;
    for (int y = 0; y <= n; y += 2) {
        const vec2 wy = vec2(y == 0 ? 1.0 - f.y : y == n ? f.y : 1.0, y + 1 > n ? 0.0 : y + 1 == n ? f.y : 1.0);
        for (int x = 0; x <= n; x += 2) {
            const vec2 wx = vec2(x == 0 ? 1.0 - f.x : x == n ? f.x : 1.0, x + 1 > n ? 0.0 : x + 1 == n ? f.x : 1.0);
            // order of a gather: (0,1) (1,1) (1,0) (0,0)
            const vec4 lit = textureGather(map, vec3((first + vec2(x + 1, y + 1)) * texel, float(layer_index)), z);
            sum += dot(lit, vec4(wx.x * wy.y, wx.y * wy.y, wx.y * wy.x, wx.x * wy.x));
        }
    }
    return min(sum / float(n * n), 1.0); // the weights add up to n * n only to rounding
}

#endif
