// SPDX-License-Identifier: Apache-2.0
// Where pages are. Include after a block `c` that has the member `grid`: a struct with arrays is slow as an argument.
#ifndef GNOMON_VIRTUAL_GRID_GLSL
#define GNOMON_VIRTUAL_GRID_GLSL

// A page of any face, level and place has an identity of its own, which stays when the table's windows move.
uvec2 page_id(int face, int level, ivec2 place) { return uvec2(face << 24 | place.x, level << 24 | place.y); }
int face_of(uvec2 id) { return int(id.x >> 24); }
int level_of(uvec2 id) { return int(id.y >> 24); }
ivec2 place_of(uvec2 id) { return ivec2(id & 0xffffffu); }

// The page at `uv`, which is less than a face's coordinates by c.grid.offset.
ivec2 page_at(vec2 uv, int level)
{
    const float pages = float(1 << level);
    return clamp(ivec2(floor(uv * pages + c.grid.offset * pages)), ivec2(0), ivec2((1 << level) - 1));
}

// Of a page's first texel, counted from uv = 0: small near the axes' origin, where it then is exact.
vec2 first_texel(ivec2 place, int level) { return (vec2(place) - c.grid.offset * float(1 << level)) * float(c.grid.page); }

bool in_window(int level, ivec2 page)
{
    const ivec2 d = page - ivec2(c.grid.level[level].window_x, c.grid.level[level].window_y);
    return all(greaterThanEqual(d, ivec2(0))) && all(lessThan(d, ivec2(c.grid.level[level].side)));
}

// Entry of the table; the page is in its level's window. Places repeat with the window's width, so that pages keep their entry when it moves.
uint entry_of(int face, int level, ivec2 page)
{
    const int side = c.grid.level[level].side;
    const ivec2 at = page & (side - 1);
    return uint(face) * c.grid.face_entries + c.grid.level[level].first + uint(at.y * side + at.x);
}

uint entry_of(uvec2 id) { return entry_of(face_of(id), level_of(id), place_of(id)); }

// The page that an entry stands for.
uvec2 id_of_entry(uint entry)
{
    const int face = int(entry / c.grid.face_entries);
    const uint rest = entry - uint(face) * c.grid.face_entries;
    int level = 0;
    while (level + 1 < c.grid.levels && rest >= c.grid.level[level + 1].first) ++level;
    const int side = c.grid.level[level].side;
    const int i = int(rest - c.grid.level[level].first);
    const ivec2 window = ivec2(c.grid.level[level].window_x, c.grid.level[level].window_y);
    return page_id(face, level, window + ((ivec2(i & (side - 1), i / side) - window) & (side - 1)));
}

// Behind the marks of entries, whether any of a run is marked: most of a large table is not looked at.
uint run_mark(uint entry) { return c.grid.entries + entry / VIRTUAL_RUN; }

// The coarsest level that is as fine as `wanted` asks and, at uv, in the table.
int level_for(float wanted, vec2 uv)
{
    int level = clamp(int(ceil(wanted)), 0, c.grid.levels - 1);
    while (level > 0 && !in_window(level, page_at(uv, level))) --level;
    return level;
}

#endif
