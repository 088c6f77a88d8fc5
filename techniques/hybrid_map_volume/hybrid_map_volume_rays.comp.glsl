// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_ray_query : require
#include "shaders/light.glsl"
#include "shaders/receiver.glsl"
#include "shaders/scene.glsl"
#include "techniques/hybrid_map_volume/hybrid_map_volume.shared.h"

// A ray towards the light's centre from each marked pixel.
layout(local_size_x = MARKED_GROUP) in;
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2, r32f) uniform writeonly image2D visibility_image;
layout(set = 0, binding = 3) uniform accelerationStructureEXT scene;
layout(set = 0, binding = 4, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 0, binding = 8, scalar) readonly buffer Marked { uint count, pixels[]; } marked;
layout(set = 1, binding = 0, scalar) uniform Constants { HybridConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"
#include "shaders/light_rays.glsl"
#include "shaders/occluded_query.glsl"

void main()
{
    // more marked pixels than groups may hold go round again
    for (uint i = gl_GlobalInvocationID.x; i < marked.count; i += gl_NumWorkGroups.x * MARKED_GROUP) {
        const uvec2 pixel = uvec2(marked.pixels[i] & 0xffffu, marked.pixels[i] >> 16);
        const Receiver r = load_receiver(c.view, depth_image, normal_image, vec2(pixel) + 0.5);
        const bool sun = c.light.kind == LIGHT_DIRECTIONAL;
        const vec4 centre = sun ? vec4(-c.light.direction, 0.0) : vec4(c.light.position, 1.0);
        const bool lit = sees_light_point(r, position_rounding(c.view, r), centre);
        imageStore(visibility_image, ivec2(pixel), vec4(lit ? 1.0 : 0.0));
    }
}
