// SPDX-License-Identifier: Apache-2.0
// A page's projection and its sides, border and all. Include after virtual_grid.glsl.
#ifndef GNOMON_VIRTUAL_PAGE_GLSL
#define GNOMON_VIRTUAL_PAGE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_box.glsl"

PageDraw page_draw(uvec2 id, uint slot)
{
    PageDraw d;
    d.slot = slot;
    d.face = uint(face_of(id));
    // clip.xy / clip.w in [-1, 1] on the page and its border
    const float drawn = float(c.grid.page + 2 * c.grid.border);
    d.scale = 2.0 * float(c.grid.page << level_of(id)) / drawn;
    const vec2 shift = -2.0 * (first_texel(place_of(id), level_of(id)) - float(c.grid.border)) / drawn - 1.0;
    d.x = shift.x, d.y = shift.y;
    const mat4 m = transpose(c.grid.face[d.face].map_from_world);
    const vec4 x = d.scale * m[0] + d.x * m[3], y = d.scale * m[1] + d.y * m[3];
    d.planes[0] = m[3] + x, d.planes[1] = m[3] - x, d.planes[2] = m[3] + y, d.planes[3] = m[3] - y;
    return d;
}

#endif
