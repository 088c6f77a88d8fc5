// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/light_map.glsl"
#include "techniques/shadow_texture/shadow_texture.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform usampler2D primitive_image;
layout(set = 0, binding = 3, scalar) readonly buffer Casters { uint caster_bits[]; };
layout(set = 0, binding = 4) uniform sampler2DArray texture_image;
layout(set = 0, binding = 5, scalar) readonly buffer Cookie { float cookie[]; }; // width, height, rows from the top
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

layout(location = 0) out float visibility;

bool is_caster(ivec2 pixel)
{
    const uint primitive = texelFetch(primitive_image, pixel, 0).r;
    return primitive / 32 < caster_bits.length() && (caster_bits[primitive / 32] >> (primitive % 32) & 1u) != 0;
}

// What the light's cookie lets through towards p: 1 behind the light; the cookie's rim goes on outside of it.
float through_cookie(vec3 p_world)
{
    const vec3 d = (p_world - c.light.position) * c.cookie_axes;
    if (c.params.cookie == 0 || d.z <= 0.0) return 1.0;
    const float turn = radians(c.params.cookie_turn) * float(c.view.frame);
    const vec2 q = mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * (d.xy / (d.z * c.cookie_scale));
    const ivec2 size = ivec2(cookie[0], cookie[1]);
    const ivec2 at = clamp(ivec2(floor((0.5 + 0.5 * vec2(q.x, -q.y)) * vec2(size))), ivec2(0), size - 1);
    return cookie[2 + at.y * size.x + at.x];
}

void main()
{
    Receiver r;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) return;
    visibility = through_cookie(r.p_world);
    if (c.params.receivers == RECEIVE_LARGE && is_caster(ivec2(gl_FragCoord.xy))) return;
    const int index = select_layer(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, r.p_world);
    const MapPoint m = project(c.map.layers[index], r.p_world);
    // outside the texture, and behind the light, where the projection would be upside down, there is no shadow
    if (m.inside) visibility *= textureLod(texture_image, vec3(m.uv, float(index)), 0.0).r;
}
