// SPDX-License-Identifier: Apache-2.0
// What vertex shaders that draw casters share: a vertex of an instance, and with CASTERS_MASKED what light_masked.glsl asks of it.
#ifndef GNOMON_CASTER_VERTEX_GLSL
#define GNOMON_CASTER_VERTEX_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"

layout(location = 0) in vec3 position;
layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };

#ifdef CASTERS_MASKED
layout(location = 2) in vec2 uv;
layout(location = 3) in uint color;
layout(location = 0) out vec3 uv_alpha;
layout(location = 1) flat out uint material;
#endif

// The vertex in the world. Writes what masked casters' fragments read.
vec4 caster_vertex(uint slot)
{
#ifdef CASTERS_MASKED
    uv_alpha = vec3(uv, unpackUnorm4x8(color).a);
    material = instances[slot].material;
#endif
    return vec4(transform_point(instances[slot], position), 1.0);
}

#endif
