// SPDX-License-Identifier: Apache-2.0
// A receiver's visibility from the slices above it. Include after covered(map_layer, slice, lo, hi).
#ifndef GNOMON_OCCLUSION_TEXTURES_RESOLVE_GLSL
#define GNOMON_OCCLUSION_TEXTURES_RESOLVE_GLSL

layout(set = 0, binding = 2) uniform sampler2DArray slices_image;

layout(constant_id = 0) const int slices = 8;
layout(constant_id = 1) const int fusion = FUSE_PRODUCT;
layout(constant_id = 2) const int own = OWN_COMPARE;
layout(constant_id = 3) const bool middle = true;

// The window on a plane is the light seen from the receiver, on [-1, 1]^2, without what the receiver's own plane hides of it: cut along the
// axis in which that plane is steeper, so that the receiver's own surface, where it rises into nearer slices, is left out.
vec4 open_part(SoftPoint p)
{
    // away from the light the plane goes down into the open; where the centre itself is hidden, the map shows the plane from below
    const vec2 rise = p.slope * p.light * (p.horizon < 0.5 ? -1.0 : 1.0);
    const float hidden = 2.0 - 2.0 * p.horizon;
    if (abs(rise.x) > abs(rise.y)) return rise.x > 0.0 ? vec4(-1.0 + hidden, -1.0, 1.0, 1.0) : vec4(-1.0, -1.0, 1.0 - hidden, 1.0);
    return rise.y > 0.0 ? vec4(-1.0, -1.0 + hidden, 1.0, 1.0) : vec4(-1.0, -1.0, 1.0, 1.0 - hidden);
}

// Of what lies in the receiver's own slice only the nearest is known, which is compared with the receiver's plane as in percentage-closer
// soft shadows: 4 x 4 texels of the window at the slice's beginning give the blockers' mean depth, and the window there the shadow.
struct OwnSlice {
    int layer, channel; // of the image of slices
    float near, far, z; // stored depth: of the slice, and of the receiver
    vec2 at, slope; // the receiver's place, and what its plane gains in stored depth from texel to texel
};

// Stored depth by which a texel's content stands before the receiver's plane; negative without any.
float height_above(OwnSlice o, vec2 texel, float content)
{
    const float place = (255.0 * content - 1.0) / 254.0;
    return place < 0.0 ? -1.0 : mix(o.far, o.near, place) - o.z - dot(o.slope, texel + 0.5 - o.at);
}

vec4 gather_content(OwnSlice o, vec2 corner)
{
    const vec3 at = vec3(corner / vec2(textureSize(slices_image, 0).xy), float(o.layer));
    if (o.channel == 0) return textureGather(slices_image, at, 0);
    if (o.channel == 1) return textureGather(slices_image, at, 1);
    if (o.channel == 2) return textureGather(slices_image, at, 2);
    return textureGather(slices_image, at, 3);
}

// Blended from 2 x 2 texels, or of the nearest one.
float covers(OwnSlice o, vec2 at, bool blend)
{
    const vec2 first = floor(at - 0.5);
    vec2 f = at - 0.5 - first;
    if (!blend) f = step(0.5, f);
    const vec4 content = gather_content(o, first + 1.0); // (0,1) (1,1) (1,0) (0,0)
    const vec4 above = vec4(height_above(o, first + vec2(0, 1), content.x), height_above(o, first + vec2(1, 1), content.y),
        height_above(o, first + vec2(1, 0), content.z), height_above(o, first, content.w));
    const vec4 c = vec4(greaterThan(above, vec4(0.0)));
    return mix(mix(c.w, c.z, f.x), mix(c.x, c.y, f.x), f.y);
}

float covered_in_own(OwnSlice o, vec2 window, vec4 open)
{
    const ivec2 most = textureSize(slices_image, 0).xy - 1;
    vec2 half_width = min(window * (o.near - o.z), vec2(1e6));
    vec2 blockers = vec2(0.0); // how many, and the sum of their heights
    for (int i = 0; i < 16; ++i) {
        const vec2 at = o.at + half_width * mix(open.xy, open.zw, (vec2(i & 3, i >> 2) + 0.5) / 4.0);
        const ivec2 texel = clamp(ivec2(floor(at)), ivec2(0), most);
        const float height = height_above(o, vec2(texel), texelFetch(slices_image, ivec3(texel, o.layer), 0)[o.channel]);
        if (height > 0.0) blockers += vec2(1.0, height);
    }
    if (blockers.x == 0.0) return 0.0;
    half_width = min(window * (blockers.y / blockers.x), vec2(1e6));
    const bool blend = max(half_width.x, half_width.y) > 0.5;
    float sum = 0.0;
    for (int i = 0; i < 16; ++i)
        sum += covers(o, o.at + half_width * mix(open.xy, open.zw, (vec2(i & 3, i >> 2) + 0.5) / 4.0), blend);
    return sum / 16.0;
}

// The plane of a slice is its end, as the paper has it: content moved away from the light falls in no window of its own surface further
// down. Receivers further off see it in the middle of its slice instead, but moved by no more than half of their distance from the end, so that
// windows are at most half as wide again.
float unblocked(SoftPoint p)
{
    const LightMapLayer layer = c.soft.map.layers[p.layer];
    const float z = stored_from_depth(layer, p.depth);
    const vec4 open = open_part(p);
    // The window of a plane has the light's width times (1 / depth - 1 / d), or under a sun d - depth. Both are differences of stored depth
    // in other units (shaders/light_map.glsl).
    const float range = layer.far - layer.near, unit = layer.perspective != 0 ? layer.near * layer.far / range : 1.0 / range;
    const vec2 window = p.light * (c.kernel_scale / (unit * layer.texel_metres));

    float through = 1.0, sum = 0.0, most = 0.0;
    for (int s = 0; s < slices; ++s) {
        const int group = p.layer * SLICE_GROUPS + (s >> 2);
        const float near = c.slices.near[group][s & 3], far = c.slices.far[group][s & 3];
        float hidden = 0.0;
        if (far > z) {
            const float plane = middle ? min(mix(far, near, 0.5), far + 0.5 * (far - z)) : far;
            const vec2 half_width = min(window * (plane - z), vec2(1e6));
            const vec2 lo = p.at + half_width * open.xy, hi = p.at + half_width * open.zw;
            hidden = covered(p.layer, s, lo, hi);
            if (fusion == FUSE_JOINED && s > 0) {
                const float before = covered(p.layer, s - 1, lo, hi);
                hidden = clamp((hidden - before) / max(1.0 - before, 1e-3), 0.0, 1.0);
            }
        } else if (own == OWN_COMPARE && near > z) {
            const int image_layer = (s >> 2) * int(c.soft.map.layer_count) + p.layer;
            const vec2 slope = -p.slope * stored_per_metre(layer, p.depth);
            hidden = covered_in_own(OwnSlice(image_layer, s & 3, near, far, z, p.at, slope), window, open);
        }
        through *= 1.0 - hidden;
        sum += hidden;
        most = max(most, hidden);
    }
    if (fusion == FUSE_SUM) return max(1.0 - sum, 0.0);
    if (fusion == FUSE_MAX) return 1.0 - most;
    if (fusion == FUSE_MEAN) return max(1.0 - 0.5 * (sum + most), 0.0);
    return through;
}

float soft_visibility(SoftPoint p) { return clamp(p.horizon * unblocked(p), 0.0, 1.0); }

#endif
