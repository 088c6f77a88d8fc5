// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/sdsm.glsl"

// One layer for each cascade, about its samples: parts::fit_parallel_layer and clip_from_world.
layout(local_size_x = LIGHT_MAP_MAX_LAYERS) in;
layout(set = 0, binding = 0, scalar) buffer Fitted { FittedMap fitted; };
layout(set = 1, binding = 0, scalar) uniform Constants { SdsmFit c; };

LightMapLayer fit_layer(SampleBounds b, LightMapLayer layer)
{
    const vec2 lo = vec2(least(b, 1), least(b, 2)), hi = vec2(most(b, 1), most(b, 2)), centre = 0.5 * (lo + hi);
    const float extent = max(max(hi.x - lo.x, hi.y - lo.y), c.least_extent) * c.rim_factor;
    // as parts::orthographic_layer
    const float depth = c.casters.y - c.casters.x, slack = max(1e-3 * depth, 0.5 * (0.1 * extent - depth));
    layer.near = min(c.casters.x, least(b, 3)) - slack;
    layer.far = max(most(b, 3), layer.near) + slack;
    const float range = layer.far - layer.near;
    // uv = 0.5 + (x - centre) / extent with v down, and reversed depth
    const mat4 map_from_axes = mat4(1.0 / extent, 0, 0, 0, 0, -1.0 / extent, 0, 0, 0, 0, -1.0 / range, 0, 0.5 - centre.x / extent,
        0.5 + centre.y / extent, layer.far / range, 1);
    layer.map_from_world = map_from_axes * c.light_axes;
    layer.texel_metres = extent / c.fallback.size;
    return layer;
}

void main()
{
    const uint i = gl_LocalInvocationID.x;
    if (i >= c.fallback.layer_count) return;
    LightMapLayer layer = c.fallback.layers[i];
    if (any_sample(fitted.cascades[i])) layer = fit_layer(fitted.cascades[i], layer);
    fitted.map.layers[i] = layer;
    const mat4 clip_from_map = mat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, -1, -1, 0, 1);
    fitted.clip_from_world[i] = clip_from_map * layer.map_from_world;
}
