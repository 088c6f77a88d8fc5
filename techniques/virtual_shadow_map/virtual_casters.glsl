// SPDX-License-Identifier: Apache-2.0
// The vertex shader of casters in pages of the pool, each a layer. The includer defines CASTERS_MASKED where light_masked.glsl follows.
#ifndef GNOMON_VIRTUAL_CASTERS_GLSL
#define GNOMON_VIRTUAL_CASTERS_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "shaders/scene.glsl"
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(location = 0) in vec3 position;
layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Pages { PageDraw pages[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Pairs { uvec2 pairs[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { DrawConstants c; };

#ifdef CASTERS_MASKED
layout(location = 2) in vec2 uv;
layout(location = 3) in uint color;
layout(location = 0) out vec3 uv_alpha;
layout(location = 1) flat out uint material;
#endif

void main()
{
    const uvec2 pair = pairs[gl_InstanceIndex];
    const uint face = pages[pair.x].face;
    const vec4 h = c.grid.face[face].map_from_world * vec4(transform_point(instances[pair.y], position), 1.0);
    gl_Layer = int(pages[pair.x].slot);
    gl_Position = vec4(pages[pair.x].scale * h.xy + vec2(pages[pair.x].x, pages[pair.x].y) * h.w, h.zw);
#ifdef CASTERS_MASKED
    uv_alpha = vec3(uv, unpackUnorm4x8(color).a);
    material = instances[pair.y].material;
#endif
}

#endif
