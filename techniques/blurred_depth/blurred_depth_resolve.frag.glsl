// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"
#include "shaders/light_map.glsl"
#include "shaders/receiver.glsl"
#include "techniques/blurred_depth/blurred_depth.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArray blurred_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

layout(location = 0) out float visibility;

void main()
{
    const Receiver r = load_receiver(c.view, depth_image, normal_image, gl_FragCoord.xy);
    visibility = 1.0;
    if (r.background) return;
    visibility = 0.0;
    if (!faces_light(c.light, r.p_world, r.n_geometric) || !light_reaches(c.light, r.p_world)) return;

    const int index = select_layer(c.map.layout_kind, c.map.centre, r.p_world);
    const MapPoint m = project(c.map.layers[index], r.p_world);
    visibility = 1.0;
    if (!m.inside) return;
    const float kept = c.params.kernel % 2 == 0 ? 0.5 : 0.0; // an even window lies half a texel to the left and top
    const vec2 at = m.uv * c.map.size - 0.5 + kept, first = floor(at), f = at - first;
    const vec4 four = textureGather(blurred_image, vec3((first + 1.0) / c.map.size, float(index)));
    const float behind = m.depth - mix(mix(four.w, four.z, f.x), mix(four.x, four.y, f.x), f.y) - c.params.bias;
    // Luft and Deussen's comparison, or the step that it softens
    visibility = c.params.compare != 0 ? 1.0 - smoothstep(0.0, c.params.softness, behind) : behind > 0.0 ? 0.0 : 1.0;
}
