// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/back_projection/back_projection.shared.h"

#define SOFT_VISIBILITY vec4 // only red is kept unless the light has an image
#include "shaders/pyramid.glsl"
#include "shaders/soft_map.glsl"
#include "techniques/back_projection/back_projection_light.glsl"

layout(set = 0, binding = 2) uniform sampler2DArray pyramid;
layout(set = 0, binding = 3, scalar) readonly buffer LightSamples { uint light_samples[]; };
layout(set = 0, binding = 4, scalar) readonly buffer LightImage { vec4 light_image[]; };

#define PATCHES 0
#define TRIANGLES 2
#define MIXED 3
#define SEARCH_MAP 0
#define SEARCH_UMBRA 2

layout(constant_id = 0) const int occluders = PATCHES;
layout(constant_id = 1) const int words = 8;
layout(constant_id = 2) const int gaps = 1;
layout(constant_id = 3) const bool textured = false;

#include "shaders/light_samples.glsl"

// What all texels of a pixel are measured by. With s the stored depth, 1/z - 1/d is proportional to s - s_p in perspective layers, and
// d - z in orthographic ones: a texel at s is stretch / (s - s_p) wide when it is projected from the receiver to the light's plane.
struct Viewpoint {
    vec2 at; // texels
    float stored; // depth of the receiver
    vec2 slope; // stored depth that its plane gains from texel to texel
    float margin; // of the comparison, in stored depth
    float stretch;
    int layer;
    int level; // of the pyramid
    int size; // texels of the finest level
    ivec2 most; // last texel of the level
};

struct Window {
    ivec2 first, last; // texels of the finest level
    vec2 stored; // least and greatest depth in it
};

LightFrame frame;

// A texel's width on the light's plane, or 0 where it does not block.
float blocker_width(Viewpoint v, ivec2 texel)
{
    if (any(lessThan(texel, ivec2(0))) || any(greaterThan(texel, v.most))) return 0.0;
    const float stored = texelFetch(pyramid, ivec3(texel, v.layer), v.level).g;
    const vec2 d = (vec2(texel) + 0.5) * float(1 << v.level) - v.at;
    // behind the receiver's plane nothing can hide the light, nor can what is as far from the light as the receiver
    if (stored <= max(v.stored + dot(v.slope, d), v.stored) + v.margin) return 0.0;
    return v.stretch / (stored - v.stored);
}

void hide(vec2 lo, vec2 hi)
{
    if (frame.turned) lo = lo.yx, hi = hi.yx;
    const vec2 x = vec2(lo.x, hi.x) * frame.scale.x, y = vec2(lo.y, hi.y) * frame.scale.y;
    // a sheared column of patches becomes a flight of steps: no gaps, and off by less than a texel
    const vec2 seen = clamp(x, -1.0, 1.0);
    const float shift = 0.5 * frame.shear * (seen.x + seen.y);
    const vec2 a = vec2(x.x, y.x - shift), b = vec2(x.y, y.y - shift);
    if (textured) {
        const vec2 p = along_sides(frame, a), q = along_sides(frame, b);
        hide_rectangle(min(p, q), max(p, q));
    } else {
        hide_rectangle(a, b);
    }
}

// Offsets of a texel's borders from the receiver; the last texel of a level holds all that is left.
vec4 texel_borders(Viewpoint v, ivec2 texel)
{
    const vec2 lo = vec2(texel << v.level), end = vec2((texel + 1) << v.level);
    return vec4(lo, mix(end, vec2(v.size), equal(texel, v.most))) - v.at.xyxy;
}

void hide_patches(Viewpoint v, ivec2 first, ivec2 last)
{
    for (int y = first.y; y <= last.y && !all_hidden(); ++y) {
        float left = gaps != 0 ? blocker_width(v, ivec2(first.x - 1, y)) : 0.0;
        for (int x = first.x; x <= last.x; ++x) {
            const float width = blocker_width(v, ivec2(x, y));
            if (width > 0.0) {
                const vec4 borders = texel_borders(v, ivec2(x, y));
                vec4 r = borders * width;
                if (gaps != 0) {
                    const float below = blocker_width(v, ivec2(x, y + 1));
                    if (left > 0.0) r.x = min(r.x, borders.x * left);
                    if (below > 0.0) r.w = max(r.w, borders.w * below);
                }
                hide(r.xy, r.zw);
            }
            left = width;
        }
    }
}

// A quad with corners at texel centres, as the rectangle between the means of its sides, which neighbours share: widths of its upper and
// lower corners on the left and on the right, 0 for the one that does not block; lo and hi: offsets of the centres.
void hide_quad(vec2 left, vec2 right, vec2 lo, vec2 hi)
{
    const bvec4 blocks = greaterThan(vec4(left, right), vec4(0.0));
    const int count = int(blocks.x) + int(blocks.y) + int(blocks.z) + int(blocks.w);
    if (count < (occluders == TRIANGLES ? 3 : 4)) return;
    // a corner that is missing stands where its neighbour in the row has it
    if (!blocks.x) left.x = right.x;
    if (!blocks.y) left.y = right.y;
    if (!blocks.z) right.x = left.x;
    if (!blocks.w) right.y = left.y;
    const vec2 a = 0.5 * vec2(lo.x * (left.x + left.y), lo.y * (left.x + right.x));
    const vec2 b = 0.5 * vec2(hi.x * (right.x + right.y), hi.y * (left.y + right.y));
    // The triangle as two strips, a quarter as wide in the half with the missing corner and three quarters in the other: its area.
    const bool missing_left = !blocks.x || !blocks.y, missing_up = !blocks.x || !blocks.z;
    for (int strip = 0; strip < (occluders == TRIANGLES ? 2 : 1); ++strip) {
        vec2 lo_strip = a, hi_strip = b;
        if (occluders == TRIANGLES) {
            const float middle = 0.5 * (a.y + b.y);
            if (strip == 0) hi_strip.y = middle;
            else lo_strip.y = middle;
            const float part = count == 4 ? 1.0 : missing_up == (strip == 0) ? 0.25 : 0.75;
            if (missing_left) lo_strip.x = mix(b.x, a.x, part);
            else hi_strip.x = mix(a.x, b.x, part);
        }
        hide(lo_strip, hi_strip);
    }
}

void hide_quads(Viewpoint v, ivec2 first, ivec2 last)
{
    const float texel = float(1 << v.level);
    for (int y = first.y - 1; y <= last.y && !all_hidden(); ++y) {
        vec2 left = vec2(0.0);
        for (int x = first.x - 1; x <= last.x + 1; ++x) {
            const vec2 right = vec2(blocker_width(v, ivec2(x, y)), blocker_width(v, ivec2(x, y + 1)));
            const vec2 hi = (vec2(x, y + 1) + 0.5) * texel - v.at;
            hide_quad(left, right, hi - texel, hi);
            left = right;
        }
    }
}

Window whole_map(Viewpoint v)
{
    return Window(ivec2(0), ivec2(v.size - 1), texelFetch(pyramid, ivec3(0, 0, v.layer), textureQueryLevels(pyramid) - 1).xy);
}

// The texels that can hide the light: those in the pyramid from the receiver over the light, cut at the nearest depth in question. Each round
// knows a nearest depth of fewer texels (Guennebaud et al. 2006, section 4.1).
Window search_window(Viewpoint v)
{
    Window w = whole_map(v);
    for (int i = 0; i < 3 && w.stored.y > v.stored; ++i) {
        const vec2 half_width = frame.reach * ((w.stored.y - v.stored) / v.stretch) + 1e-3;
        const vec2 lo = v.at - half_width, hi = v.at + half_width;
        w.stored = min_max_window(pyramid, v.layer, lo, hi);
        w.first = ivec2(clamp(floor(lo), 0.0, float(v.size - 1)));
        w.last = ivec2(clamp(floor(hi), 0.0, float(v.size - 1)));
    }
    return w;
}

float visible_light(Viewpoint v)
{
    Window w = whole_map(v);
    if (c.params.search != SEARCH_MAP) {
        w = search_window(v);
        if (w.stored.y <= v.stored) return 1.0;
        const vec2 far = max(abs(vec2(w.first) - v.at), abs(vec2(w.last + 1) - v.at));
        const float plane = v.stored + dot(abs(v.slope), far) + v.margin;
        if (c.params.search == SEARCH_UMBRA && w.stored.x > plane) return 0.0;
    }
    while (max((w.last.x >> v.level) - (w.first.x >> v.level), (w.last.y >> v.level) - (w.first.y >> v.level)) >= c.params.budget) ++v.level;
    v.most = max(ivec2(v.size >> v.level), 1) - 1;
    // a coarse texel holds its nearest depth, wherever in it: the receiver's plane may be nearer there than at the middle
    v.margin += (abs(v.slope.x) + abs(v.slope.y)) * 0.5 * float((1 << v.level) - 1);
    const ivec2 first = min(w.first >> v.level, v.most), last = min(w.last >> v.level, v.most);
    if (occluders == PATCHES || (occluders == MIXED && v.level == 0)) hide_patches(v, first, last);
    else hide_quads(v, first, last);
    return visible_part();
}

// `visible` is what visible_light says, which may know that all or nothing is hidden without having looked at samples.
vec3 colored_visibility(SoftPoint p, float visible)
{
    const vec3 n = p.receiver.n_geometric, centre = c.soft.light.position - p.receiver.p_world;
    const vec3 above = p.horizon >= 1.0 ? vec3(1.0) : emitted_above(dot(n, centre), dot(n, c.soft.light.half_u), dot(n, c.soft.light.half_v));
    const vec3 seen = visible <= 0.0 || visible >= 1.0 ? vec3(visible) : visible_colors();
    return max(vec3(0.0), above - (1.0 - seen));
}

void main()
{
    SoftPoint p;
    if (!find_soft_point(p)) return;
    const LightMapLayer layer = c.soft.map.layers[p.layer];
    const vec3 p_world = p.receiver.p_world;
    const float depth = dot(layer.depth_plane, vec4(p_world, 1.0));
    const float per_metre = stored_per_metre(layer, depth);

    Viewpoint v;
    v.at = p.at;
    v.stored = stored_from_depth(layer, depth);
    v.slope = -p.slope * per_metre;
    v.margin = max(4e-6 * v.stored, 1e-7) + c.soft.params.bias * (abs(v.slope.x) + abs(v.slope.y));
    v.stretch = layer.texel_metres * (layer.perspective != 0 ? per_metre * depth * depth : per_metre);
    v.layer = p.layer;
    v.level = 0;
    v.size = int(c.soft.map.size);

    frame = light_frame(c.soft.light, layer_axes(layer), (v.at - 0.5 * c.soft.map.size) * layer.texel_metres);
    // areas of a disk: those of the square of its size
    if (words == 0 && c.soft.light.kind != LIGHT_RECT) frame.scale *= 1.12837917;
    // All that blocks lies above the receiver's plane, and so does what it hides of the light: not a factor of the part up there.
    const float visible = visible_light(v);
    visibility = vec4(max(0.0, p.horizon - (1.0 - visible)));
    if (textured) visibility.rgb = colored_visibility(p, visible);
}
