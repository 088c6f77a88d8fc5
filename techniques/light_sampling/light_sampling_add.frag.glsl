// SPDX-License-Identifier: Apache-2.0
// Adds what some layers say to the sum of those before, one after the other, so that the sum is the same however they are batched.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"
#include "shaders/light_map.glsl"
#include "shaders/percentage_closer.glsl"
#include "shaders/receiver.glsl"
#include "techniques/light_sampling/light_sampling.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArray map_image;
layout(set = 0, binding = 3) uniform sampler2D sum_image;
layout(set = 1, binding = 0, scalar) uniform Constants { AddConstants c; };

layout(constant_id = 0) const bool bilinear = true;

layout(location = 0) out vec4 visibility; // only red is kept unless the light has an image

float lit_in_layer(Receiver r, int index)
{
    const vec4 point = c.samples[index].point;
    const vec3 to_point = point.w == 0.0 ? point.xyz : point.xyz - r.p_world;
    if (dot(r.n_geometric, to_point) <= 0.0) return 0.0;
    const int face = c.samples[index].face;
    if (face >= 0 && select_cube_layer(point.xyz, mat3(1.0), r.p_world) != face) return 0.0;
    const LightMapLayer layer = c.map.layers[index];
    const MapPoint m = project(layer, r.p_world);
    if (!m.inside) return 1.0;
    // Each texel is compared with the receiver's plane at its centre: no bias for planes. The limit holds where the light grazes.
    ReceiverPlane plane = receiver_plane(layer, c.map.size, c.map.depth_step, m, r.p_world, r.n_geometric, 1.0, 16.0);
    plane.z += c.params.bias * (abs(plane.slope.x) + abs(plane.slope.y));
    return compare_tap(map_image, index, plane, vec2(0.0), vec2(1.0 / c.map.size), bilinear, false);
}

void main()
{
    const Receiver r = load_receiver(c.view, depth_image, normal_image, gl_FragCoord.xy);
    visibility = vec4(1.0);
    if (r.background) return;
    visibility = vec4(0.0, 0.0, 0.0, 1.0);
    if (!light_reaches(c.light, r.p_world)) return;
    vec3 sum = texelFetch(sum_image, ivec2(gl_FragCoord.xy), 0).rgb;
    for (int i = 0; i < int(c.map.layer_count); ++i) sum += lit_in_layer(r, i) * c.samples[i].weight;
    visibility.rgb = c.last != 0 ? min(sum / float(c.count), vec3(1.0)) : sum;
}
