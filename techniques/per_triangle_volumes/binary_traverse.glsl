// SPDX-License-Identifier: Apache-2.0
// Opaque and masked casters: a hit sample is dark.
#ifndef GNOMON_BINARY_TRAVERSE_GLSL
#define GNOMON_BINARY_TRAVERSE_GLSL
#include "techniques/per_triangle_volumes/traverse_bindings.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { Tree tree; };
#define TREE tree
#include "techniques/per_triangle_volumes/tree.glsl"

#include "shaders/alpha.glsl"

bool begins(Volume v) { return true; }

bool takes_tiles(Volume v) { return (v.slot & VOLUME_MASKED) == 0; }

// A triangle does not darken itself.
bool hits(Volume v, uvec2 at, vec3 e)
{
    if (texelFetch(primitive_image, ivec2(pixel_of(at)), 0).r == v.primitive) return false;
    if ((v.slot & VOLUME_MASKED) == 0) return true;
    const uint slot = v.slot >> 4;
    return mask_keeps(slot, v.primitive - instances[slot].first_primitive, e.yz / (e.x + e.y + e.z));
}

void settle(uint word, uint children) { atomicOr(words[word], children); }

#include "techniques/per_triangle_volumes/traverse.glsl"

#endif
