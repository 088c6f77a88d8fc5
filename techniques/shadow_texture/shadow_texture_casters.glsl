// SPDX-License-Identifier: Apache-2.0
// Casters as a light's layers see them; receivers are left out. The includer defines CASTERS_MASKED where light_masked.glsl follows.
#ifndef GNOMON_SHADOW_TEXTURE_CASTERS_GLSL
#define GNOMON_SHADOW_TEXTURE_CASTERS_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "shaders/scene.glsl"
#include "techniques/shadow_texture/shadow_texture.shared.h"

layout(location = 0) in vec3 position;
layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Casters { uint caster_bits[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { CasterConstants c; };

#ifdef CASTERS_MASKED
layout(location = 2) in vec2 uv;
layout(location = 3) in uint color;
layout(location = 0) out vec3 uv_alpha;
layout(location = 1) flat out uint material;
#endif

void main()
{
    const Instance instance = instances[instance_slot(gl_InstanceIndex)];
    gl_Layer = instance_layer(gl_InstanceIndex);
    gl_Position = c.clip_from_world[gl_Layer] * vec4(transform_point(instance, position), 1.0);
    const uint first = instance.first_primitive;
    if ((caster_bits[first / 32] >> (first % 32) & 1u) == 0) gl_Position = vec4(0.0, 0.0, 0.0, -1.0); // all three corners: nothing is drawn
#ifdef CASTERS_MASKED
    uv_alpha = vec3(uv, unpackUnorm4x8(color).a);
    material = instance.material;
#endif
}

#endif
