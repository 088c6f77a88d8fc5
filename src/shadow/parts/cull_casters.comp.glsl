// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/casters.shared.h"
#include "src/shadow/parts/cull.shared.h"
#include "src/shadow/parts/ordered_float.glsl"

// A draw command for each caster (along x) and layer (along y): of one instance, or of none.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Casters { Caster casters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Mask { uint mask[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Commands { DrawCommand commands[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { CullConstants c; };

layout(constant_id = 0) const bool masked = true; // else all that touches a layer is drawn

// Whether a receiver looks into the square between two corners of the layer, from behind `depth`.
bool shades(int index, vec2 lo, vec2 hi, float depth)
{
    if (any(lessThan(hi, vec2(0.0))) || any(greaterThan(lo, vec2(1.0)))) return false;
    if (!masked) return true;
    const ivec2 most = ivec2(CULL_MASK_SIZE - 1);
    const ivec2 first = clamp(ivec2(floor(lo * float(CULL_MASK_SIZE))), ivec2(0), most), last = clamp(ivec2(floor(hi * float(CULL_MASK_SIZE))), ivec2(0), most);
    const uint nearer = ordered_from_float(depth);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (mask[(index * CULL_MASK_SIZE + y) * CULL_MASK_SIZE + x] > nearer) return true;
    return false;
}

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    const int index = int(gl_WorkGroupID.y);
    if (i >= c.casters) return;
    const Caster caster = casters[i];
    const LightMapLayer layer = c.map.layers[index];
    vec2 lo = vec2(1e30), hi = vec2(-1e30);
    float depth = 1e30;
    for (int k = 0; k < 8; ++k) {
        const vec4 p = vec4(mix(caster.least, caster.most, notEqual(ivec3(k) & ivec3(1, 2, 4), ivec3(0))), 1.0);
        const vec2 uv = (layer.map_from_world * p).xy; // parallel: w = 1
        lo = min(lo, uv);
        hi = max(hi, uv);
        depth = min(depth, dot(layer.depth_plane, p));
    }
    // what is drawn rounds otherwise than its bounds: a texel, and a ten-thousandth of the depth
    lo -= layer.texel_uv;
    hi += layer.texel_uv;
    const bool drawn = caster.blended == 0u && shades(index, lo, hi, depth - 1e-4 * (layer.far - layer.near));
    commands[uint(index) * c.casters + i] = DrawCommand(caster.index_count, drawn ? 1u : 0u, caster.first_index, caster.vertex_offset, i | uint(index) << 24);
}
