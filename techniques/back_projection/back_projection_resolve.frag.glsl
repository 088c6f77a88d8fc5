// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/back_projection/back_projection.shared.h"

#define SOFT_VISIBILITY vec4 // only red is kept unless the light has an image
#include "shaders/n_buffer.glsl"
#include "shaders/pyramid.glsl"
#include "shaders/soft_map.glsl"
#include "techniques/back_projection/back_projection_light.glsl"

layout(set = 0, binding = 2) uniform sampler2DArray pyramid;
layout(set = 0, binding = 3, scalar) readonly buffer LightSamples { uint light_samples[]; };
layout(set = 0, binding = 4, scalar) readonly buffer LightImage { vec4 light_image[]; };
layout(set = 0, binding = 5) uniform sampler2DArray windows;

#define PATCHES 0
#define TRIANGLES 2
#define MIXED 3
#define SEARCH_UMBRA 2
#define LEVELS_WINDOW 0

layout(constant_id = 0) const int occluders = PATCHES;
layout(constant_id = 1) const int words = 8;
layout(constant_id = 2) const int gaps = 1;
layout(constant_id = 3) const bool textured = false;
layout(constant_id = 4) const int levels = LEVELS_WINDOW;
layout(constant_id = 5) const int ranges = RANGES_PYRAMID;

#include "shaders/light_samples.glsl"

// What all texels of a pixel are measured by. With s the stored depth, 1/z - 1/d is proportional to s - s_p in perspective layers, and
// d - z in orthographic ones: a texel at s is stretch / (s - s_p) wide when it is projected from the receiver to the light's plane.
struct Viewpoint {
    vec2 at; // texels
    float stored; // depth of the receiver
    vec2 slope; // stored depth that its plane gains from texel to texel
    bool faces_light; // else its plane hides the light's centre, and what lies above it is further from there
    float margin; // of the comparison, in stored depth
    float stretch;
    int layer;
    int level; // of the pyramid
    int size; // texels of the finest level
    ivec2 most; // last texel of the level
    vec2 slice; // stored depths of the casters that are read at this level
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
    ivec2 at = texel;
    vec2 middle = (vec2(texel) + 0.5) * float(1 << v.level);
    if (levels != LEVELS_WINDOW) {
        at = (texel << v.level) + ((1 << v.level) >> 1);
        middle = vec2(at) + 0.5;
    }
    const float stored = texelFetch(pyramid, ivec3(at, v.layer), levels != LEVELS_WINDOW ? 0 : v.level).g;
    if (stored <= v.slice.x || stored > v.slice.y) return 0.0;
    // behind the receiver's plane nothing can hide the light, nor can what is as far from the light as the receiver
    const float above = stored - v.stored - dot(v.slope, middle - v.at);
    if (stored <= v.stored + v.margin || (v.faces_light ? above : -above) <= v.margin) return 0.0;
    return v.stretch / (stored - v.stored);
}

void hide(vec2 lo, vec2 hi)
{
    if (frame.turned) lo = lo.yx, hi = hi.yx;
    const vec2 x = frame.scale.x * vec2(lo.x, hi.x) / max(1.0 - frame.bend * vec2(lo.x, hi.x), 1e-6);
    // a sheared column of patches becomes a flight of steps: no gaps, and off by less than a texel
    const vec2 seen = clamp(x, -1.0, 1.0);
    const float middle = 0.5 * (seen.x + seen.y);
    const vec2 y = frame.scale.y * (1.0 - frame.turn * middle) * vec2(lo.y, hi.y) - frame.shear * middle;
    const vec2 a = vec2(x.x, y.x), b = vec2(x.y, y.y);
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

// Whether nothing of the light is left.
bool all_blocks(Viewpoint v, Window w)
{
    const vec2 far = max(abs(vec2(w.first) - v.at), abs(vec2(w.last + 1) - v.at));
    const float rise = dot(abs(v.slope), far);
    return v.faces_light ? w.stored.x > v.stored + rise + v.margin : w.stored.x > v.stored + v.margin && w.stored.y < v.stored - rise - v.margin;
}

Window whole_map(Viewpoint v)
{
    return Window(ivec2(0), ivec2(v.size - 1), texelFetch(pyramid, ivec3(0, 0, v.layer), textureQueryLevels(pyramid) - 1).xy);
}

// The texels in the pyramid from the receiver over the light, cut at a stored depth.
Window seen_window(Viewpoint v, float nearest)
{
    const vec2 half_width = frame.reach * ((nearest - v.stored) / v.stretch) + 1e-3;
    const vec2 lo = v.at - half_width, hi = v.at + half_width, most = vec2(v.size - 1);
    const vec2 stored = ranges == RANGES_PYRAMID ? min_max_window(pyramid, v.layer, lo, hi)
                                                 : min_max_window(pyramid, windows, c.windows, v.layer, lo, hi);
    return Window(ivec2(clamp(floor(lo), vec2(0.0), most)), ivec2(clamp(floor(hi), vec2(0.0), most)), stored);
}

// The texels that can hide the light. Each round knows a nearest depth of fewer of them (Guennebaud et al. 2006, section 4.1).
Window search_window(Viewpoint v)
{
    Window w = whole_map(v);
    for (int i = 0; i < 3 && w.stored.y > v.stored; ++i) w = seen_window(v, w.stored.y);
    return w;
}

void hide_level(Viewpoint v, Window w)
{
    v.most = max(ivec2(v.size >> v.level), 1) - 1;
    const ivec2 first = min(w.first >> v.level, v.most), last = min(w.last >> v.level, v.most);
    if (occluders == PATCHES || (occluders == MIXED && v.level == 0)) hide_patches(v, first, last);
    else hide_quads(v, first, last);
}

// All casters of a window at the finest level that holds it.
void hide_window(Viewpoint v, Window w)
{
    while (max((w.last.x >> v.level) - (w.first.x >> v.level), (w.last.y >> v.level) - (w.first.y >> v.level)) >= c.params.budget) ++v.level;
    // a coarse texel holds its nearest depth, wherever in it: the receiver's plane may be nearer there than at the middle
    v.margin += (abs(v.slope.x) + abs(v.slope.y)) * 0.5 * float((1 << v.level) - 1);
    hide_level(v, w);
}

// Slices of casters, each twice as deep as the one before (in stored depth, to which the light's width in texels is proportional) and read
// at a level twice as coarse: a texel hides at most 2 / budget of the light's width, or is one of the map. Where a surface crosses from one
// slice to the next, a coarse texel may have its middle in the finer one and parts that lie in neither: an eighth is read at both.
void hide_slices(Viewpoint v, Window w)
{
    const float unit = 0.5 * float(c.params.budget - 1) * v.stretch / max(frame.reach.x, frame.reach.y);
    const int coarsest = textureQueryLevels(pyramid) - 1;
    for (bool last = false; !last && !all_hidden(); ++v.level) {
        const float depth = unit * float(1 << v.level);
        last = v.stored + depth >= w.stored.y || v.level == coarsest;
        v.slice = v.stored + vec2(v.level == 0 ? 0.0 : 0.4375 * depth, last ? 1e30 : depth);
        Window s = w;
        if (c.params.search != SEARCH_MAP) {
            const float nearest = min(v.slice.y, w.stored.y);
            s = seen_window(v, nearest);
            if (s.stored.y <= v.slice.x || s.stored.x > v.slice.y) continue;
            s.first = max(s.first, w.first);
            s.last = min(s.last, w.last);
        }
        hide_level(v, s);
    }
}

// Hides what the casters of one layer hide of the light; true where nothing of it is left.
bool hide_casters(Viewpoint v)
{
    Window w = whole_map(v);
    if (c.params.search != SEARCH_MAP) {
        w = search_window(v);
        if (w.stored.y <= v.stored) return false;
        if (c.params.search == SEARCH_UMBRA && all_blocks(v, w)) return true;
    }
    if (levels == LEVELS_WINDOW) hide_window(v, w);
    else hide_slices(v, w);
    return all_hidden();
}

float visible_light(Viewpoint v)
{
    for (int k = 0; k < c.params.layers; ++k, v.layer += int(c.soft.map.layer_count))
        if (hide_casters(v)) return 0.0;
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

vec4 soft_visibility(SoftPoint p)
{
    const LightMapLayer layer = c.soft.map.layers[p.layer];
    const vec3 p_world = p.receiver.p_world;
    const float depth = dot(layer.depth_plane, vec4(p_world, 1.0));
    const float per_metre = stored_per_metre(layer, depth);

    Viewpoint v;
    v.at = p.at;
    v.stored = stored_from_depth(layer, depth);
    v.slope = -p.slope * per_metre;
    v.margin = max(stored_rounding(layer, v.stored), 1e-7) + c.soft.params.bias * (abs(v.slope.x) + abs(v.slope.y));
    v.stretch = layer.texel_metres * (layer.perspective != 0 ? per_metre * depth * depth : per_metre);
    v.faces_light = dot(p.receiver.n_geometric, to_light(c.soft.light, p_world).xyz) > 0.0;
    v.layer = p.layer;
    v.level = 0;
    v.slice = vec2(-1.0, 1e30);
    v.size = int(c.soft.map.size);

    frame = light_frame(c.soft.light, layer_axes(layer), (v.at - layer.axis_uv * c.soft.map.size) * layer.texel_metres, depth);
    // areas of a disk: those of the square of its size
    if (words == 0 && c.soft.light.kind != LIGHT_RECT) frame.scale *= 1.12837917;
    // All that blocks lies above the receiver's plane, and so does what it hides of the light: not a factor of the part up there.
    hide_nothing();
    const float visible = visible_light(v);
    const float lit = max(0.0, p.horizon - (1.0 - visible));
    return textured ? vec4(colored_visibility(p, visible), lit) : vec4(lit);
}
