// SPDX-License-Identifier: Apache-2.0
// Which of the marked pages are used. Include after virtual_grid.glsl and a buffer `counts`.
#ifndef GNOMON_VIRTUAL_COUNTS_GLSL
#define GNOMON_VIRTUAL_COUNTS_GLSL

#define MARK_REQUESTED 1u
#define MARK_COVERS 2u // holds a requested page of a finer level

// With all requests of finer levels moved to the pages of level l that hold them, sum(k < l) direct_k + covering_l pages are used, which
// grows with l: the finest level for which they fit. It follows from this frame's requests alone, not from what earlier ones left.
uint finest_level()
{
    uint finest = 0, coarser = 0;
    for (int l = 0; l < c.grid.levels; ++l) {
        if (coarser + counts.covering[l] <= uint(c.grid.pool)) finest = uint(l);
        coarser += counts.direct[l];
    }
    return finest;
}

bool is_needed(uint mark, int level, uint finest)
{
    return uint(level) < finest ? (mark & MARK_REQUESTED) != 0u : uint(level) == finest && mark != 0u;
}

#endif
