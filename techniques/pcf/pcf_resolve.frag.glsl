// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/bias.glsl"
#include "shaders/hard_receiver.glsl"
#include "shaders/noise.glsl"
#include "shaders/percentage_closer.glsl"
#include "techniques/pcf/pcf.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArray map_image;
layout(set = 0, binding = 3) uniform sampler2D noise_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

layout(constant_id = 0) const int form = PCF_BOX;
layout(constant_id = 1) const bool bilinear = true;
layout(constant_id = 2) const int bias = BIAS_CONE;
layout(constant_id = 3) const int rotation = ROTATE_NONE;
layout(constant_id = 4) const bool adaptive = false;
layout(constant_id = 5) const bool footprint = false;
// A small fixed kernel, or 0: known to the compiler, so that the filter's loops are unrolled.
layout(constant_id = 6) const int small_kernel = 0;

layout(location = 0) out float visibility;

// Width in texels of the pixel's own footprint on the receiver, as the map sees it: the longest side of the parallelogram between this
// pixel and its neighbours, cast along the eye's rays onto the receiver's plane.
float footprint_texels(LightMapLayer layer, Receiver r, vec2 at)
{
    float longest = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        const vec2 pixel = gl_FragCoord.xy + vec2(axis == 0, axis == 1);
        const vec3 q = world_from_depth(c.view, pixel, texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r);
        const vec3 ray = c.view.orthographic != 0 ? c.view.forward : normalize(q - c.view.eye);
        const float across = dot(r.n_geometric, ray);
        const vec3 neighbour = q - ray * (dot(r.n_geometric, q - r.p_world) / (across > -1e-3 ? -1e-3 : across));
        longest = max(longest, distance(project(layer, neighbour).uv * c.map.size, at));
    }
    return longest;
}

// Taps of the disk; with groups, those of this pixel's group alone: every group has taps of all radii.
float disk_filter(int layer_index, ReceiverPlane plane, float radius)
{
    const ivec2 pixel = ivec2(gl_FragCoord.xy), tile = pixel / c.groups, place = pixel - tile * c.groups;
    const int first = place.y * c.groups + place.x, stride = c.groups * c.groups;
    const mat2 turned = radius * tap_rotation(rotation, noise_image, tile, c.view.frame);
    const vec2 texel = 1.0 / vec2(textureSize(map_image, 0).xy);
    const int count = c.taps / stride, probes = adaptive ? min(8, count) : count;
    float sum = 0.0;
    for (int i = 0; i < probes; ++i)
        sum += compare_tap(map_image, layer_index, plane, turned * c.disk[i * stride + first], texel, bilinear, bias == BIAS_CONE);
    if (!adaptive || sum == 0.0 || sum == float(probes)) return sum / float(probes);
    for (int i = probes; i < count; ++i)
        sum += compare_tap(map_image, layer_index, plane, turned * c.disk[i * stride + first], texel, bilinear, bias == BIAS_CONE);
    return sum / float(count);
}

float lit_in_layer(Receiver r, int index)
{
    const LightMapLayer layer = layer_at(c.map.layers[index], r.p_world);
    int n = small_kernel > 0 ? small_kernel : c.kernel;
    if (footprint) n = clamp(int(ceil(footprint_texels(layer, r, project(layer, r.p_world).uv * c.map.size))), n, c.largest);
    bool inside;
    const ReceiverPlane plane = biased_plane(bias, c.params.bias, layer, c.map.size, c.map.depth_step, c.light, r.p_world, r.n_geometric,
        0.5 * float(n) + c.beyond, inside);
    if (!inside) return 1.0;
    if (form == PCF_POISSON || form == PCF_VOGEL) return disk_filter(index, plane, 0.5 * float(n));
    const int reconstruct = form == PCF_BICUBIC ? RECONSTRUCT_BICUBIC : bilinear ? RECONSTRUCT_BILINEAR : RECONSTRUCT_NEAREST;
    return separable_filter(map_image, index, plane, n, form == PCF_GAUSSIAN, reconstruct, bias == BIAS_CONE, adaptive);
}

void main()
{
    Receiver r;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) return;
    const Layers layers = select_layers(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, c.map.bands, r.p_world);
    visibility = 0.0;
    for (int i = 0; i < count_of(layers); ++i) visibility += share_of(layers, i) * lit_in_layer(r, layers.first + i);
}
