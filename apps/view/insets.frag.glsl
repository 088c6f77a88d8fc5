// SPDX-License-Identifier: Apache-2.0
// The layers of the technique's map beside one another: light = near the light, blue = nothing there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "apps/view/composite.shared.h"
#include "shaders/light_map.glsl"

layout(set = 0, binding = 0) uniform sampler2DArray map;
layout(set = 1, binding = 0, scalar) uniform Constants { MapOverlayConstants c; };

layout(location = 0) out vec4 color;

void main()
{
    const uvec2 at = uvec2(gl_FragCoord.xy) / c.cell;
    const uint layer = at.y * c.columns + at.x;
    color = vec4(0.0, 0.0, 0.0, 1.0);
    if (at.x >= c.columns || layer >= c.map.layer_count) return;
    const vec2 uv = (gl_FragCoord.xy - vec2(at * c.cell)) / float(c.cell);
    const float z = textureLod(map, vec3(uv, float(layer)), 0.0).r;
    const float near = c.map.layers[layer].near, far = c.map.layers[layer].far;
    float depth = far - z * (far - near);
    if (c.map.layers[layer].perspective != 0) depth = near * far / (z * (far - near) + near);
    color.rgb = z == 0.0 ? vec3(0.08, 0.12, 0.3) : vec3(clamp(1.0 - 0.9 * (depth - near) / (far - near), 0.0, 1.0));
    if (any(lessThan(uv * float(c.cell), vec2(1.0)))) color.rgb = vec3(0.5);
}
