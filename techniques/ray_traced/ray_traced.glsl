// SPDX-License-Identifier: Apache-2.0
// What both ways of tracing share: bindings, ray origins, the estimate. Each way defines
//   bool occluded(vec3 origin, vec3 direction, float from, float to)
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

bool occluded(vec3 origin, vec3 direction, float from, float to);

// The receiver's position comes from a depth image through an inverse matrix, so it lies off its triangle by a few units in the
// last place of the eye's distance and of its own coordinates. Moving off the plane by more than that keeps the segment open
// at the receiver's end: neither its own triangle nor its neighbours in the plane block it. (By the scene's extent instead, the
// offset under a mountain range was 6 mm and let light in below a roof.)
float rounding(Receiver r)
{
    const vec3 a = abs(r.p_world);
    return 2.5e-6 * (max(a.x, max(a.y, a.z)) + distance(c.view.eye, r.p_world));
}

// The ray also begins as far along its way: where another surface touches the receiver's (a table's leg the floor), rounding can put
// the point on the wrong side of that one.
float sample_visible(Receiver r, float error, vec2 u)
{
    const vec3 origin = r.p_world + r.n_geometric * error;
    const vec4 point = light_point(c.light, r.p_world, u);
    const vec3 to_point = point.w == 0.0 ? point.xyz : point.xyz - r.p_world;
    if (dot(r.n_geometric, to_point) <= 0.0) return 0.0;
    if (point.w == 0.0) return occluded(origin, point.xyz, error, 1e30) ? 0.0 : 1.0;
    const vec3 d = point.xyz - origin;
    const float length_d = length(d);
    return occluded(origin, d / length_d, error, length_d) ? 0.0 : 1.0;
}

float trace_visibility(Receiver r, uvec2 pixel)
{
    if (!light_reaches(c.light, r.p_world)) return 0.0;
    const float error = rounding(r);
    const bool hard = c.light.radius == 0.0;
    const int strata = hard ? 1 : int(ceil(sqrt(float(c.params.samples)) - 1e-4));
    float sum = 0.0;
    for (int i = 0; i < strata * strata; ++i) {
        const vec2 jitter = random2(uvec3(pixel, uint(i) + c.view.frame * 65536u));
        sum += sample_visible(r, error, (vec2(i % strata, i / strata) + jitter) / float(strata));
    }
    return sum / float(strata * strata);
}

void write_pixel(uvec2 pixel)
{
    const Receiver r = load_receiver(c.view, depth_image, normal_image, vec2(pixel) + 0.5);
    imageStore(visibility_image, ivec2(pixel), vec4(r.background ? 1.0 : trace_visibility(r, pixel)));
}
