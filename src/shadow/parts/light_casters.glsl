// SPDX-License-Identifier: Apache-2.0
// The vertex shader of a pass that draws casters into a light's layers. The includer names its block of constants, CASTER_CONSTANTS, whose
// first member is clip_from_world for each layer, and defines CASTERS_MASKED where light_masked.glsl follows, CASTERS_WARPED where fragments
// write their depth, CASTERS_IDS where they write whose they are.
#ifndef GNOMON_LIGHT_CASTERS_GLSL
#define GNOMON_LIGHT_CASTERS_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "src/shadow/parts/caster_vertex.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { CASTER_CONSTANTS c; };

layout(location = 2) flat out int layer;
#ifdef CASTERS_WARPED
layout(location = 3) out float before_far; // metres along the layer's axis, from the far plane towards the light
#endif

#ifdef CASTERS_IDS
layout(location = 4) flat out uint first_primitive;
#endif

void main()
{
    const uint slot = instance_slot(gl_InstanceIndex);
    gl_Layer = layer = instance_layer(gl_InstanceIndex);
    const vec4 p_world = caster_vertex(slot);
    gl_Position = c.clip_from_world[gl_Layer] * p_world;
#ifdef CASTERS_WARPED
    const vec4 range = c.ranges[gl_Layer];
    const float depth = dot(c.depth_planes[gl_Layer], p_world);
    before_far = range.y - depth;
    gl_Position.z = 0.5 * gl_Position.w; // nothing is clipped in depth, but what lies behind a light
    gl_ClipDistance[0] = range.z != 0.0 ? depth - range.x : 1.0;
#endif
#ifdef CASTERS_IDS
    first_primitive = instances[slot].first_primitive;
#endif
}

#endif
