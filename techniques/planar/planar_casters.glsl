// SPDX-License-Identifier: Apache-2.0
// Casters flattened onto a plane. The includer defines CASTERS_MASKED where src/shadow/parts/light_masked.glsl follows.
#ifndef GNOMON_PLANAR_CASTERS_GLSL
#define GNOMON_PLANAR_CASTERS_GLSL
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/caster_vertex.glsl"
#include "techniques/planar/planar.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { CasterConstants c; };

void main()
{
    const vec4 p = caster_vertex(instance_slot(gl_InstanceIndex));
    gl_Position = c.clip_from_caster * p;
    // Triangles that reach below the plane or past the light are cut there, exactly: interpolated from corner to corner.
    gl_ClipDistance[0] = dot(c.above, p);
    gl_ClipDistance[1] = dot(c.before, p);
}

#endif
