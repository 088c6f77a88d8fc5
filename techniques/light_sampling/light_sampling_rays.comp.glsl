// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_ray_query : require
#include "shaders/light.glsl"
#include "shaders/receiver.glsl"
#include "shaders/scene.glsl"
#include "techniques/light_sampling/light_sampling.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform writeonly image2D visibility_image; // only red is kept unless the light has an image
layout(set = 0, binding = 3) uniform accelerationStructureEXT scene;
layout(set = 0, binding = 4, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 0, binding = 8, scalar) readonly buffer Points { vec4 points[]; }; // and then their weights
layout(set = 1, binding = 0, scalar) uniform Constants { RayConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"
#include "shaders/light_rays.glsl"
#include "shaders/occluded_query.glsl"

void main()
{
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(c.view.size)))) return;
    const Receiver r = load_receiver(c.view, depth_image, normal_image, vec2(pixel) + 0.5);
    vec4 visibility = vec4(1.0);
    if (!r.background) {
        vec3 sum = vec3(0.0);
        const float error = position_rounding(c.view, r);
        if (light_reaches(c.light, r.p_world))
            for (uint i = 0; i < c.count; ++i)
                if (sees_light_point(r, error, points[i])) sum += points[c.count + i].rgb;
        visibility.rgb = min(sum / float(c.count), vec3(1.0));
    }
    imageStore(visibility_image, pixel, visibility);
}
