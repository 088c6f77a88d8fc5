// SPDX-License-Identifier: Apache-2.0
// Which of the marked pages are used. Include after a block `c` with the member `grid` and a buffer `counts`.
#ifndef GNOMON_VIRTUAL_COUNTS_GLSL
#define GNOMON_VIRTUAL_COUNTS_GLSL

// Bit b of a page's mark: with all requests lowered by b levels, some sample uses the page. The least b for which the pages fit into the
// pool follows from this frame's requests alone, not from what earlier ones left there. Level 0 has one page a face: it always fits.
uint levels_lowered()
{
    uint b = 0u;
    while (b + 1u < uint(c.grid.levels) && counts.requested[b] > uint(c.grid.pool)) ++b;
    return b;
}

#endif
