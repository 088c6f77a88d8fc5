// SPDX-License-Identifier: Apache-2.0
// `occluded` of shaders/light_rays.glsl by ray queries. Include after shaders/alpha.glsl and the acceleration structure `scene`.
#ifndef GNOMON_OCCLUDED_QUERY_GLSL
#define GNOMON_OCCLUDED_QUERY_GLSL

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

#endif
