// SPDX-License-Identifier: Apache-2.0
// What a surface lets through: the GLSL twin of scene::transmittance (tests/gpu/shader_functions_test.cpp holds them together).
#ifndef GNOMON_MATERIAL_GLSL
#define GNOMON_MATERIAL_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"

// Of one crossing, per colour channel: 1 = clear, 0 = opaque. `base` is the base colour with texture and vertex colour, linear.
vec3 transmittance(Material material, vec4 base)
{
    base = clamp(base, 0.0, 1.0);
    const vec3 glass = base.rgb * material.transmission * material.volume_tint;
    if ((material.flags & MATERIAL_MASK) != 0u) return base.a >= material.alpha_cutoff ? glass : vec3(1.0);
    if ((material.flags & MATERIAL_BLEND) != 0u) return mix(vec3(1.0), base.rgb, base.a) * (1.0 - base.a) + base.a * glass;
    return glass;
}

#endif
