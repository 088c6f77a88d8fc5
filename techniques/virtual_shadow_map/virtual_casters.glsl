// SPDX-License-Identifier: Apache-2.0
// The vertex shader of casters in pages of the pool, each a layer. The includer defines CASTERS_MASKED where light_masked.glsl follows.
#ifndef GNOMON_VIRTUAL_CASTERS_GLSL
#define GNOMON_VIRTUAL_CASTERS_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "src/shadow/parts/caster_vertex.glsl"
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(set = 0, binding = 2, scalar) readonly buffer Pages { PageDraw pages[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Pairs { uvec2 pairs[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { DrawConstants c; };

void main()
{
    const uvec2 pair = pairs[gl_InstanceIndex];
    const uint face = pages[pair.x].face;
    const vec4 h = c.grid.face[face].map_from_world * caster_vertex(pair.y);
    gl_Layer = int(pages[pair.x].slot);
    gl_Position = vec4(pages[pair.x].scale * h.xy + vec2(pages[pair.x].x, pages[pair.x].y) * h.w, h.zw);
}

#endif
