// SPDX-License-Identifier: Apache-2.0
// What the window shows of the drawn sides, encoded for the screen.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "apps/view/composite.shared.h"
#include "shaders/receiver.glsl"

layout(set = 0, binding = 0) uniform sampler2D left_radiance;
layout(set = 0, binding = 1) uniform sampler2D right_radiance;
layout(set = 0, binding = 2) uniform sampler2D left_visibility;
layout(set = 0, binding = 3) uniform sampler2D right_visibility;
layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5) uniform usampler2D normal_image;
layout(set = 0, binding = 6) uniform sampler2D albedo_image;
layout(set = 0, binding = 7) uniform sampler2D surface_image;
layout(set = 0, binding = 8) uniform usampler2D primitive_image;
layout(set = 0, binding = 9) uniform sampler2D footprint_image;
layout(set = 0, binding = 10) uniform sampler2D layers_image;
layout(set = 0, binding = 11) uniform usampler2D truth_primitive;
layout(set = 0, binding = 12) uniform sampler2D volumes_image;
layout(set = 0, binding = 13) uniform sampler2D inspect_image;
layout(set = 1, binding = 0, scalar) uniform Constants { CompositeConstants c; };

layout(location = 0) out vec4 color;

// The twin of lab::display.
vec3 pbr_neutral(vec3 x)
{
    const float start = 0.8 - 0.04, desaturation = 0.15;
    const float low = min(x.r, min(x.g, x.b));
    x -= low < 0.08 ? low - 6.25 * low * low : 0.04;
    const float peak = max(x.r, max(x.g, x.b));
    if (peak < start) return x;
    const float d = 1.0 - start, new_peak = 1.0 - d * d / (peak + d - start);
    x *= new_peak / peak;
    return mix(x, vec3(new_peak), 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0));
}

vec3 srgb(vec3 x)
{
    x = clamp(x, 0.0, 1.0);
    return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

// ColorBrewer's RdBu, as metrics::signed_heat_map: red where the left side is too light, blue where it is too dark.
vec3 heat(float t)
{
    const vec3 dark[4] = vec3[4](vec3(1.0), vec3(0.573, 0.773, 0.871), vec3(0.129, 0.400, 0.675), vec3(0.020, 0.188, 0.380));
    const vec3 light[4] = vec3[4](vec3(1.0), vec3(0.957, 0.647, 0.510), vec3(0.698, 0.094, 0.169), vec3(0.404, 0.0, 0.122));
    const float at = min(abs(t), 1.0) * 3.0;
    const int i = min(int(at), 2);
    return t < 0.0 ? mix(dark[i], dark[i + 1], at - float(i)) : mix(light[i], light[i + 1], at - float(i));
}

// Octaves of pixels per texel, as lab::aov_display: white where a texel is one to two pixels long.
vec3 footprint(float value)
{
    const vec3 ramp[11] = vec3[11](vec3(0.03, 0.09, 0.30), vec3(0.08, 0.23, 0.52), vec3(0.20, 0.43, 0.72), vec3(0.50, 0.69, 0.86), vec3(0.95),
        vec3(1.00, 0.90, 0.55), vec3(0.99, 0.72, 0.30), vec3(0.96, 0.48, 0.18), vec3(0.85, 0.22, 0.13), vec3(0.62, 0.05, 0.12), vec3(0.36, 0.0, 0.14));
    if (!(value > 0.0)) return vec3(0.0);
    return ramp[clamp(int(floor(log2(value))) + 4, 0, 10)];
}

vec3 visibility(vec4 texel, uint colored) { return colored != 0 ? texel.rgb : texel.rrr; }

vec3 signed_error(ivec2 pixel)
{
    const uint seen = texelFetch(primitive_image, pixel, 0).r;
    const bool scored = c.right >= RIGHT_TECHNIQUE && seen != 0xffffffffu
        && (c.right != RIGHT_TRUTH || texelFetch(truth_primitive, pixel, 0).r == seen);
    if (!scored) return vec3(0.604);
    const vec3 d = visibility(texelFetch(left_visibility, pixel, 0), c.left_colored) - visibility(texelFetch(right_visibility, pixel, 0), c.right_colored);
    return heat((d.r + d.g + d.b) / 3.0 / c.range);
}

vec3 aov(ivec2 pixel)
{
    const float stored = texelFetch(depth_image, pixel, 0).r;
    const Receiver r = load_receiver(c.view, depth_image, normal_image, gl_FragCoord.xy);
    if (c.show == SHOW_ALBEDO) return srgb(texelFetch(albedo_image, pixel, 0).rgb);
    if (c.show == SHOW_SURFACE) return vec3(texelFetch(surface_image, pixel, 0).rg, 0.0);
    if (c.show >= SHOW_FOOTPRINT) return footprint(texelFetch(footprint_image, pixel, 0)[c.show - SHOW_FOOTPRINT]);
    if (stored == 0.0) return vec3(0.0);
    if (c.show == SHOW_DEPTH) return vec3(1.0 - dot(r.p_world - c.view.eye, c.view.forward) / c.farthest);
    if (c.show == SHOW_NORMAL) return 0.5 + 0.5 * r.n_shading;
    if (c.show == SHOW_GEOMETRIC_NORMAL) return 0.5 + 0.5 * r.n_geometric;
    if (c.show == SHOW_POSITION) return 0.5 + 0.5 * r.p_world / c.extent;
    const uint hash = texelFetch(primitive_image, pixel, 0).r * 2654435761u;
    return vec3(hash & 255u, hash >> 8 & 255u, hash >> 16 & 255u) / 255.0;
}

bool edge_of_triangle(ivec2 pixel)
{
    const ivec2 last = ivec2(c.view.size) - 1;
    const uint own = texelFetch(primitive_image, pixel, 0).r;
    return own != texelFetch(primitive_image, min(pixel + ivec2(1, 0), last), 0).r || own != texelFetch(primitive_image, min(pixel + ivec2(0, 1), last), 0).r;
}

void main()
{
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const bool other = c.right != RIGHT_NONE && gl_FragCoord.x > c.split;
    const bool missing = other && c.right == RIGHT_MISSING;
    vec3 shown;
    if (c.show == SHOW_LIT)
        shown = srgb(pbr_neutral(c.exposure * (other && !missing ? texelFetch(right_radiance, pixel, 0) : texelFetch(left_radiance, pixel, 0)).rgb));
    else if (c.show == SHOW_VISIBILITY)
        shown = other && !missing ? visibility(texelFetch(right_visibility, pixel, 0), c.right_colored)
                                  : visibility(texelFetch(left_visibility, pixel, 0), c.left_colored);
    else if (c.show == SHOW_ERROR) shown = signed_error(pixel);
    else shown = aov(pixel);
    if (missing && c.show <= SHOW_VISIBILITY) shown *= 0.4;
    if (c.layers != 0) {
        const vec4 tint = texelFetch(layers_image, pixel, 0);
        shown = mix(shown, tint.rgb, 0.35 * tint.a);
    }
    if (c.inspect != 0 && !other) {
        const vec4 tint = texelFetch(inspect_image, pixel, 0);
        shown = mix(shown, tint.rgb, tint.a);
    }
    if (c.volumes != 0) {
        const vec4 line = texelFetch(volumes_image, pixel, 0); // times its coverage
        shown = shown * (1.0 - line.a) + line.rgb;
    }
    if (c.wireframe != 0 && edge_of_triangle(pixel)) shown = mix(shown, vec3(0.1, 0.9, 0.4), 0.6);
    color = vec4(clamp(shown, 0.0, 1.0), 1.0);
}
