// SPDX-License-Identifier: Apache-2.0
// A receiver's visibility from the slices above it. Include after covered(map_layer, slice, lo, hi).
#ifndef GNOMON_OCCLUSION_TEXTURES_RESOLVE_GLSL
#define GNOMON_OCCLUSION_TEXTURES_RESOLVE_GLSL

layout(set = 0, binding = 2) uniform sampler2DArray slices_image;

layout(constant_id = 0) const int slices = 8;
layout(constant_id = 1) const int fusion = FUSE_PRODUCT;
layout(constant_id = 2) const int own = OWN_COMPARE;

// The window on a plane is the light seen from the receiver, on [-1, 1]^2, without what the receiver's own plane hides of it: cut along the
// axis in which that plane is steeper, so that the receiver's own surface, where it rises into nearer slices, is left out.
vec4 open_part(SoftPoint p)
{
    const vec2 rise = p.slope * p.light;
    const float hidden = 2.0 - 2.0 * p.horizon;
    if (abs(rise.x) > abs(rise.y)) return rise.x > 0.0 ? vec4(-1.0 + hidden, -1.0, 1.0, 1.0) : vec4(-1.0, -1.0, 1.0 - hidden, 1.0);
    return rise.y > 0.0 ? vec4(-1.0, -1.0 + hidden, 1.0, 1.0) : vec4(-1.0, -1.0, 1.0, 1.0 - hidden);
}

// Of what lies in the receiver's own slice, only the nearest is known: 3 x 3 texels, of the window half-way between the slice's beginning and
// the receiver, are compared with the receiver's plane.
float covered_in_own(SoftPoint p, int slice, float z, vec2 slope, vec2 lo, vec2 hi)
{
    const int group = slice >> 2;
    const float near = c.slices.near[p.layer * SLICE_GROUPS + group][slice & 3], far = c.slices.far[p.layer * SLICE_GROUPS + group][slice & 3];
    const ivec2 most = textureSize(slices_image, 0).xy - 1;
    float blocked = 0.0;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) {
            const ivec2 texel = clamp(ivec2(floor(mix(lo, hi, (vec2(x, y) + 0.5) / 3.0))), ivec2(0), most);
            const float content = texelFetch(slices_image, ivec3(texel, group * int(c.soft.map.layer_count) + p.layer), 0)[slice & 3];
            const float place = (255.0 * content - 1.0) / 254.0;
            blocked += place >= 0.0 && mix(far, near, place) > z + dot(slope, vec2(texel) + 0.5 - p.at) ? 1.0 : 0.0;
        }
    return blocked / 9.0;
}

float unblocked(SoftPoint p)
{
    const LightMapLayer layer = c.soft.map.layers[p.layer];
    const float per_metre = stored_per_metre(layer, p.depth), z = stored_from_depth(layer, p.depth);
    const vec4 open = open_part(p);
    // Windows shrink as stored depth falls to the receiver's: with s = a / depth + b, light (1 / depth - 1 / d) = light (s - s_d) / a, and
    // d^2 times what a metre changes s there is a.
    vec2 window = p.light / (per_metre * layer.texel_metres);
    if (layer.perspective != 0) window /= max(p.depth * p.depth, 1e-20);
    window *= c.kernel_scale;

    float through = 1.0, sum = 0.0, most = 0.0;
    for (int s = 0; s < slices; ++s) {
        const int group = p.layer * SLICE_GROUPS + (s >> 2);
        const float near = c.slices.near[group][s & 3], far = c.slices.far[group][s & 3];
        float hidden = 0.0;
        if (far > z) {
            const vec2 half_width = window * (far - z);
            hidden = covered(p.layer, s, p.at + half_width * open.xy, p.at + half_width * open.zw);
        } else if (own == OWN_COMPARE && near > z) {
            const vec2 half_width = window * (0.5 * (near - z));
            hidden = covered_in_own(p, s, z, -p.slope * per_metre, p.at + half_width * open.xy, p.at + half_width * open.zw);
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

void main()
{
    SoftPoint p;
    if (find_soft_point(p)) visibility = clamp(p.horizon * unblocked(p), 0.0, 1.0);
}

#endif
