// SPDX-License-Identifier: Apache-2.0
// Boxes before the sides of pages.
#ifndef GNOMON_VIRTUAL_BOX_GLSL
#define GNOMON_VIRTUAL_BOX_GLSL

// Whether a box reaches into a side's half space, give or take rounding.
bool reaches(vec4 plane, vec3 centre, vec3 extent)
{
    const float at = dot(plane.xyz, centre), far = dot(abs(plane.xyz), extent);
    return at + plane.w + far >= -1e-5 * (dot(abs(plane.xyz), abs(centre)) + abs(plane.w));
}

bool reaches(PageDraw d, vec3 centre, vec3 extent)
{
    return reaches(d.planes[0], centre, extent) && reaches(d.planes[1], centre, extent) && reaches(d.planes[2], centre, extent)
        && reaches(d.planes[3], centre, extent);
}

#endif
