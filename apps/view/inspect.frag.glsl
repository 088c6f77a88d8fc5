// SPDX-License-Identifier: Apache-2.0
// Colours of an image that a technique offers for inspection; alpha is 0 where it says nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "apps/view/composite.shared.h"
#include "shaders/receiver.glsl"

layout(set = 0, binding = 0) uniform sampler2D values;
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 1, binding = 0, scalar) uniform Constants { InspectConstants c; };

layout(location = 0) out vec4 color;

vec3 label_color(uint label)
{
    uint h = (label + 1u) * 2654435761u;
    h ^= h >> 15;
    h *= 2246822519u;
    const vec3 hue = clamp(abs(fract(float(h >> 8) * (1.0 / 16777216.0) + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return mix(vec3(1.0), hue, 0.75) * (0.65 + 0.35 * float(h & 255u) / 255.0);
}

void main()
{
    const float value = texelFetch(values, ivec2(gl_FragCoord.xy), 0).r;
    color = vec4(0.0);
    if (!(value >= 0.0)) return;
    if (c.label != 0) {
        color = vec4(label_color(uint(value)), 0.55);
        return;
    }
    float length = value;
    if (c.in_pixels != 0) {
        const vec3 p = world_from_depth(c.view, gl_FragCoord.xy, texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r);
        length /= 2.0 * c.view.pixel_radius * (c.view.orthographic != 0 ? 1.0 : dot(p - c.view.eye, c.view.forward));
    }
    const float at = clamp(length / c.most, 0.0, 1.0) * float(INSPECT_COLORS - 1);
    const int i = min(int(at), INSPECT_COLORS - 2);
    color = vec4(mix(c.colors[i], c.colors[i + 1], at - float(i)), 0.8);
}
