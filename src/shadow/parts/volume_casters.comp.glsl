// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/n_buffer.glsl"
#include "src/shadow/casters.shared.h"
#include "src/shadow/parts/ordered_float.glsl"
#include "src/shadow/parts/volume_mask.shared.h"

// In which bands each instance may darken a receiver: those marked in a texel that its box covers, with receivers behind the box's nearest
// point.
layout(local_size_x = VOLUME_CULL_GROUP) in;
layout(set = 0, binding = 0, scalar) readonly buffer Casters { Caster casters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Mask { uint everywhere; VolumeTexel texels[]; };
layout(set = 0, binding = 2, scalar) buffer Slots { uint slots[]; };
layout(set = 0, binding = 3) uniform sampler2DArray window_image;
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeMaskConstants c; };

layout(constant_id = 0) const bool whole_box = true; // ask the windows for the box's texels at once
layout(constant_id = 1) const bool by_texel = true; // look at each of them

// What a box covers of a layer: the rays from the light through its points.
struct Cover {
    bool any;
    vec2 lo, hi; // uv
    float nearest; // metres along the layer's axis
};

// Corners beside or behind the layer's eye have no image: h / w with w in (0, most] then runs from h / most on, as far as h's sign lets it.
vec2 bound_beside(vec2 h, float most_w) { return vec2(h.x >= 0.0 ? h.x / most_w : -1e30, h.y <= 0.0 ? h.y / most_w : 1e30); }

Cover cover_of(LightMapLayer layer, Caster caster)
{
    vec3 least = vec3(1e30), most = vec3(-1e30); // of u w, v w, w
    Cover box = Cover(false, vec2(1e30), vec2(-1e30), 1e30);
    for (int k = 0; k < 8; ++k) {
        const vec4 p = vec4(mix(caster.least, caster.most, notEqual(ivec3(k) & ivec3(1, 2, 4), ivec3(0))), 1.0);
        const vec3 h = (layer.map_from_world * p).xyw;
        least = min(least, h);
        most = max(most, h);
        box.lo = min(box.lo, h.xy / h.z);
        box.hi = max(box.hi, h.xy / h.z);
        box.nearest = min(box.nearest, dot(layer.depth_plane, p));
    }
    if (!(least.z > 1e-4 * most.z)) {
        const vec2 u = bound_beside(vec2(least.x, most.x), most.z), v = bound_beside(vec2(least.y, most.y), most.z);
        box.lo = vec2(u.x, v.x);
        box.hi = vec2(u.y, v.y);
    }
    // what is drawn rounds otherwise than the box: half a texel, and a part of the depth
    box.lo -= 0.5 / float(VOLUME_MASK_SIZE);
    box.hi += 0.5 / float(VOLUME_MASK_SIZE);
    box.nearest -= 1e-4 * (layer.far - layer.near);
    box.any = most.z > 0.0 && all(lessThanEqual(box.lo, vec2(1.0))) && all(greaterThanEqual(box.hi, vec2(0.0)));
    return box;
}

uint bands_in(int index, Cover box, uint lane)
{
    const ivec2 most = ivec2(VOLUME_MASK_SIZE - 1);
    const ivec2 first = min(ivec2(max(box.lo, vec2(0.0)) * float(VOLUME_MASK_SIZE)), most);
    const ivec2 last = min(ivec2(min(box.hi, vec2(1.0)) * float(VOLUME_MASK_SIZE)), most);
    if (whole_box) {
        if (min_max_rectangle(window_image, c.windows, index, first, last).y < box.nearest) return 0u;
        if (!by_texel) return ~0u;
    }
    const uint nearest = ordered_from_float(box.nearest), width = uint(last.x - first.x + 1), count = width * uint(last.y - first.y + 1);
    uint bands = 0u;
    for (uint k = lane; k < count; k += VOLUME_CULL_GROUP) {
        const int x = first.x + int(k % width), y = first.y + int(k / width);
        const VolumeTexel texel = texels[(index * VOLUME_MASK_SIZE + y) * VOLUME_MASK_SIZE + x];
        if (texel.reach >= nearest) bands |= texel.bands;
    }
    return bands;
}

void main()
{
    const uint slot = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (slot >= c.slots) return;
    uint bands = everywhere;
    for (int index = 0; index < int(c.map.layer_count); ++index) {
        const Cover box = cover_of(c.map.layers[index], casters[slot]);
        if (box.any) bands |= bands_in(index, box, gl_LocalInvocationIndex);
    }
    bands &= c.bands < 32u ? (1u << c.bands) - 1u : ~0u;
    if (bands != 0u && (slots[slot] | bands) != slots[slot]) atomicOr(slots[slot], bands);
}
