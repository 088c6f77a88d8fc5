// SPDX-License-Identifier: Apache-2.0
// Casters as a light's layers see them; receivers are left out. The includer defines CASTERS_MASKED where light_masked.glsl follows.
#ifndef GNOMON_SHADOW_TEXTURE_CASTERS_GLSL
#define GNOMON_SHADOW_TEXTURE_CASTERS_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "src/shadow/parts/caster_vertex.glsl"
#include "techniques/shadow_texture/shadow_texture.shared.h"

layout(set = 0, binding = 2, scalar) readonly buffer Casters { uint caster_bits[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { CasterConstants c; };

void main()
{
    const uint slot = instance_slot(gl_InstanceIndex), first = instances[slot].first_primitive;
    gl_Layer = instance_layer(gl_InstanceIndex);
    gl_Position = c.clip_from_world[gl_Layer] * caster_vertex(slot);
    if ((caster_bits[first / 32] >> (first % 32) & 1u) == 0) gl_Position = vec4(0.0, 0.0, 0.0, -1.0); // all three corners: nothing is drawn
}

#endif
