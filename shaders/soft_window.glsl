// SPDX-License-Identifier: Apache-2.0
// How wide a light with an area is in its light map, as a receiver sees it.
#ifndef GNOMON_SOFT_WINDOW_GLSL
#define GNOMON_SOFT_WINDOW_GLSL
#include "shaders/light_horizon.glsl"
#include "shaders/light_map.glsl"

// Half the light's extent along a vector across the ray from the receiver to its centre.
float light_half_width(Light light, vec3 along)
{
    if (light.kind == LIGHT_RECT) return abs(dot(light.half_u, along)) + abs(dot(light.half_v, along));
    if (light.kind == LIGHT_DISK) return length(vec2(dot(light.half_u, along), dot(light.half_v, along)));
    return sun_or_radius(light) * length(along);
}

// Half the extents, along the map's axes, of the light as the receiver's rays cast it onto the plane through its centre that is parallel to
// the layer: metres, or for orthographic layers the tangent of half the angle. The rays are taken for parallel. A rectangle or disk that
// lies in that plane is itself; a sphere off the layer's axis is wider by 1 / cos; and one side of a panel seen from beside its plane, from a
// face that it stands across, is as wide as it looks from there. Of warped layers: in units of which a texel's width takes texel_metres.
vec2 light_half_size(LightMapLayer layer, Light light, vec3 p_world)
{
    const vec3 axis = layer.depth_plane.xyz;
    // where the ray through p lies on the plane at unit depth
    const vec4 h = layer.map_from_world * vec4(p_world, 1.0);
    vec2 size;
    for (int k = 0; k < 2; ++k) {
        if (layer.warped != 0) {
            const vec3 along = gradient_of_uv(layer, k, h.xy / h.w);
            const float depth = layer.perspective != 0 ? dot(axis, p_world) + layer.depth_plane.w : 1.0;
            size[k] = light_half_width(light, along) * (depth * layer.texel_metres / (layer.texel_uv * h.w));
            continue;
        }
        // a row of the projection, without the part of perspective that puts the layer's axis into its place, is an axis of the map
        const bool perspective = layer.perspective != 0;
        vec3 row = vec3(layer.map_from_world[0][k], layer.map_from_world[1][k], layer.map_from_world[2][k]);
        row -= layer.axis_uv[k] * axis;
        const float scale = length(row);
        const float tangent = perspective ? (h[k] / max(h.w, layer.near) - layer.axis_uv[k]) / scale : 0.0;
        size[k] = light_half_width(light, row / scale - tangent * axis);
    }
    return size;
}

// Half the width, in texels, of what the pyramid over the light with its apex at the receiver's depth d cuts out at depth z: the search
// window (z: the nearest depth in question) and the filter's (z: the blockers'). With l the light's half width, the pyramid is
// l (d - z) / d wide there, which from the light's centre is a tangent of l (d - z) / (d z) (Fernando 2005, "Percentage-closer soft
// shadows"); under a sun of angular radius a it is (d - z) tan(a).
vec2 window_half_width(LightMapLayer layer, vec2 light, float d, float z)
{
    const float between = max(d - z, 0.0);
    if (layer.perspective == 0) return light * (between / layer.texel_metres);
    return light * (between / (max(z, layer.near) * max(d, layer.near) * layer.texel_metres));
}

#endif
