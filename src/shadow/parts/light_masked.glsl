// SPDX-License-Identifier: Apache-2.0
// Fragments of masked casters, after light_casters.glsl with CASTERS_MASKED.
#ifndef GNOMON_LIGHT_MASKED_GLSL
#define GNOMON_LIGHT_MASKED_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/scene.glsl"

layout(location = 0) in vec3 uv_alpha;
layout(location = 1) flat in uint material;
layout(set = 0, binding = 1, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

bool caster_is_there()
{
    // finest level, as in ray-traced truth
    const TextureUse use = materials[material].base_color_texture;
    float alpha = materials[material].base_color.a * uv_alpha.z;
    if (use.index >= 0) alpha *= textureLod(textures[nonuniformEXT(use.index)], transform_uv(use, uv_alpha.xy), 0.0).a;
    return alpha >= materials[material].alpha_cutoff;
}

#endif
