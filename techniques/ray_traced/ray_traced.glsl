// SPDX-License-Identifier: Apache-2.0
// What both ways of tracing share: bindings and the estimate. Each way defines `occluded` of shaders/light_rays.glsl.
#include "shaders/light.glsl"
#include "shaders/random.glsl"
#include "shaders/receiver.glsl"
#include "shaders/scene.glsl"
#include "techniques/ray_traced/ray_traced.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2, r32f) uniform writeonly image2D visibility_image;
layout(set = 0, binding = 3) uniform accelerationStructureEXT scene;
layout(set = 0, binding = 4, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { TraceConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"
#include "shaders/light_rays.glsl"

float trace_visibility(Receiver r, uvec2 pixel)
{
    if (!light_reaches(c.light, r.p_world)) return 0.0;
    const float error = position_rounding(c.view, r);
    const bool hard = c.light.radius == 0.0;
    const int strata = hard ? 1 : int(ceil(sqrt(float(c.params.samples)) - 1e-4));
    float sum = 0.0;
    for (int i = 0; i < strata * strata; ++i) {
        const vec2 jitter = random2(uvec3(pixel, uint(i) + c.view.frame * 65536u));
        const vec4 point = light_point(c.light, r.p_world, (vec2(i % strata, i / strata) + jitter) / float(strata));
        sum += sees_light_point(r, error, point) ? 1.0 : 0.0;
    }
    return sum / float(strata * strata);
}

void write_pixel(uvec2 pixel)
{
    const Receiver r = load_receiver(c.view, depth_image, normal_image, vec2(pixel) + 0.5);
    imageStore(visibility_image, ivec2(pixel), vec4(r.background ? 1.0 : trace_visibility(r, pixel)));
}
