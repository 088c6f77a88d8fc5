// SPDX-License-Identifier: Apache-2.0
// A colour for each layer of the technique's map, where receivers look into it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "apps/view/composite.shared.h"
#include "shaders/light_map.glsl"
#include "shaders/receiver.glsl"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 1, binding = 0, scalar) uniform Constants { MapOverlayConstants c; };

layout(location = 0) out vec4 color;

void main()
{
    const vec3 colors[LIGHT_MAP_MAX_LAYERS] = vec3[LIGHT_MAP_MAX_LAYERS](vec3(0.9, 0.2, 0.2), vec3(0.2, 0.8, 0.2), vec3(0.2, 0.4, 1.0),
        vec3(0.95, 0.85, 0.1), vec3(0.9, 0.2, 0.9), vec3(0.1, 0.85, 0.85), vec3(1.0, 0.55, 0.1), vec3(0.6, 0.6, 0.6));
    const float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
    const vec3 p = world_from_depth(c.view, gl_FragCoord.xy, depth);
    const int layer = select_layer(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, p);
    color = depth == 0.0 ? vec4(0.0) : vec4(colors[clamp(layer, 0, LIGHT_MAP_MAX_LAYERS - 1)], 1.0);
}
