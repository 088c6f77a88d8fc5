// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_ray_query : require
#include "techniques/ray_traced/ray_traced.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

bool occluded(vec3 origin, vec3 direction, float from, float to)
{
    rayQueryEXT query;
    rayQueryInitializeEXT(query, scene, gl_RayFlagsTerminateOnFirstHitEXT, 0xff, origin, from, direction, to);
    while (rayQueryProceedEXT(query)) { // only masked triangles come here: the others are opaque to the hardware
        const uint slot = rayQueryGetIntersectionInstanceCustomIndexEXT(query, false);
        const uint triangle = rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
        if (mask_keeps(slot, triangle, rayQueryGetIntersectionBarycentricsEXT(query, false))) rayQueryConfirmIntersectionEXT(query);
    }
    return rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
}

void main()
{
    if (all(lessThan(gl_GlobalInvocationID.xy, uvec2(c.view.size)))) write_pixel(gl_GlobalInvocationID.xy);
}
