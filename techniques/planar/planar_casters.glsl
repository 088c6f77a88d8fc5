// SPDX-License-Identifier: Apache-2.0
// Casters flattened onto a plane. The includer defines CASTERS_MASKED where src/shadow/parts/light_masked.glsl follows.
#ifndef GNOMON_PLANAR_CASTERS_GLSL
#define GNOMON_PLANAR_CASTERS_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"
#include "techniques/planar/planar.shared.h"

layout(location = 0) in vec3 position;
layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { CasterConstants c; };

#ifdef CASTERS_MASKED
layout(location = 2) in vec2 uv;
layout(location = 3) in uint color;
layout(location = 0) out vec3 uv_alpha;
layout(location = 1) flat out uint material;
#endif

void main()
{
    const uint slot = instance_slot(gl_InstanceIndex);
    const vec4 p = vec4(transform_point(instances[slot], position), 1.0);
    gl_Position = c.clip_from_caster * p;
    // Triangles that reach below the plane or past the light are cut there, exactly: interpolated from corner to corner.
    gl_ClipDistance[0] = dot(c.above, p);
    gl_ClipDistance[1] = dot(c.before, p);
#ifdef CASTERS_MASKED
    uv_alpha = vec3(uv, unpackUnorm4x8(color).a);
    material = instances[slot].material;
#endif
}

#endif
