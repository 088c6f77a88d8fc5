// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_ray_query : require

// One ray a thread down -z; 1 where it hits an opaque triangle, 2 where a non-opaque one is left to the shader.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform accelerationStructureEXT scene;
layout(set = 0, binding = 1, r32f) writeonly uniform image2D picture;

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(picture);
    if (any(greaterThanEqual(p, size))) return;
    const vec2 ndc = (vec2(p) + 0.5) / vec2(size) * 2.0 - 1.0;
    rayQueryEXT ray;
    rayQueryInitializeEXT(ray, scene, gl_RayFlagsNoneEXT, 0xff, vec3(ndc.x, -ndc.y, 5.0), 0.0, vec3(0.0, 0.0, -1.0), 100.0);
    float hit = 0.0;
    while (rayQueryProceedEXT(ray)) hit = 2.0;
    if (rayQueryGetIntersectionTypeEXT(ray, true) != gl_RayQueryCommittedIntersectionNoneEXT)
        hit = 1.0 + float(rayQueryGetIntersectionInstanceCustomIndexEXT(ray, true));
    imageStore(picture, p, vec4(hit));
}
