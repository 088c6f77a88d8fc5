// SPDX-License-Identifier: Apache-2.0
// Where pages are. Include after a block `c` that has the member `grid`: a struct with arrays is slow as an argument.
#ifndef GNOMON_VIRTUAL_GRID_GLSL
#define GNOMON_VIRTUAL_GRID_GLSL

// A page of any face, level and place has an identity of its own, which stays when the table's windows move: 4 bits of level, 14 each of
// row and column; faces of a level lie side by side.
uint page_id(int face, int level, ivec2 page) { return uint(level) << 28 | uint(page.y) << 14 | uint((face << level) + page.x); }
int level_of(uint id) { return int(id >> 28); }
int face_of(uint id) { return int(id & 16383u) >> level_of(id); }
ivec2 place_of(uint id) { return ivec2(id & ((1u << level_of(id)) - 1u), id >> 14 & 16383u); }

ivec2 page_at(vec2 uv, int level) { return clamp(ivec2(floor(uv * float(1 << level))), ivec2(0), ivec2((1 << level) - 1)); }

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

uint entry_of(uint id) { return entry_of(face_of(id), level_of(id), place_of(id)); }

// The page that an entry stands for.
uint id_of_entry(uint entry)
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

// The coarsest level that is as fine as `wanted` asks and, at uv, in the table.
int level_for(float wanted, vec2 uv)
{
    int level = clamp(int(ceil(wanted)), 0, c.grid.levels - 1);
    while (level > 0 && !in_window(level, page_at(uv, level))) --level;
    return level;
}

#endif
