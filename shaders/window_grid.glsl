// SPDX-License-Identifier: Apache-2.0
// A window divided into a grid of parts. Inside the window they are cut at whole texels, so that four of them share an entry of the table: with g
// parts a side (g + 3)^2 fetches, where parts that begin and end inside texels take 16 g^2 entries. Only the window's own rim covers parts
// of texels, as without them penumbrae would move by whole texels.
#ifndef GNOMON_WINDOW_GRID_GLSL
#define GNOMON_WINDOW_GRID_GLSL

// Whoever includes this defines Sums and Means, the types of a table's entries and of averages over them (uvec2 and vec2, say); a constant
// `grid`, parts a side; the types KernelSettings, with a member `centred`, and Evidence; and these.
Sums sums_at(ivec2 entry); // of a summed-area table
ivec2 texels_of_map();
void weigh_part(inout Evidence e, KernelSettings k, Means mean, vec2 lo, vec2 hi, float area); // area: its share of the window

// A window along one axis, not empty and within the map: the texel in which it begins, and that in which it ends or one behind its end.
struct GridAxis {
    float lo, hi;
    int first, last, size;
};

GridAxis grid_axis(float lo, float hi, int size)
{
    const float least = 1.0 / 64.0;
    lo = clamp(lo, 0.0, float(size) - least);
    hi = clamp(hi, lo + least, float(size));
    const int first = int(floor(lo));
    return GridAxis(lo, hi, first, max(int(floor(hi)), first + 1), size);
}

// Where part i begins, and part i - 1 ends.
float grid_cut(GridAxis a, int i)
{
    if (i == 0) return a.lo;
    if (i == grid) return a.hi;
    return min(clamp(round(mix(a.lo, a.hi, float(i) / float(grid))), float(a.first + 1), float(a.last)), a.hi);
}

// The parts are made of grid + 2 runs of texels: the first and the last part of two each, one of them a texel of which only a part counts.
int run_begin(GridAxis a, int run)
{
    if (run <= 1) return a.first + run;
    if (run > grid) return min(a.last + run - grid - 1, a.size);
    return clamp(int(round(mix(a.lo, a.hi, float(run - 1) / float(grid)))), a.first + 1, a.last);
}

float run_weight(GridAxis a, int run)
{
    if (run == 0) return min(a.hi, float(a.first + 1)) - a.lo;
    return run == grid + 1 ? max(a.hi - float(a.last), 0.0) : 1.0;
}

// How much a blocker in the window's middle counts more than one at its rim (Burley 2006): 64 times.
float centre_weight(KernelSettings k, vec2 offset) { return k.centred ? exp2(-6.0 * dot(offset, offset)) : 1.0; }

void add_grid(inout Evidence e, KernelSettings k, vec2 lo, vec2 hi)
{
    const ivec2 size = texels_of_map();
    const GridAxis across = grid_axis(lo.x, hi.x, size.x), down = grid_axis(lo.y, hi.y, size.y);
    const vec2 extent = vec2(across.hi - across.lo, down.hi - down.lo), middle = vec2(across.lo, down.lo) + 0.5 * extent;
    Sums above[grid + 3];
    for (int x = 0; x < grid + 3; ++x) above[x] = sums_at(ivec2(run_begin(across, x), run_begin(down, 0)));
    Means part[grid];
    for (int x = 0; x < grid; ++x) part[x] = Means(0.0);

    for (int run = 0; run < grid + 2; ++run) {
        const int y = run_begin(down, run + 1);
        const float weight = run_weight(down, run);
        Sums entry = sums_at(ivec2(across.first, y));
        Sums left = entry - above[0];
        above[0] = entry;
        for (int x = 0; x < grid + 2; ++x) {
            entry = sums_at(ivec2(run_begin(across, x + 1), y));
            const Sums right = entry - above[x + 1];
            above[x + 1] = entry;
            part[clamp(x - 1, 0, grid - 1)] += weight * run_weight(across, x) * Means(right - left);
            left = right;
        }
        if (run == 0 || run == grid) continue; // a row of parts that the next run completes
        const int row = min(run - 1, grid - 1);
        for (int x = 0; x < grid; ++x) {
            const vec2 at = vec2(grid_cut(across, x), grid_cut(down, row)), end = vec2(grid_cut(across, x + 1), grid_cut(down, row + 1));
            const float texels = (end.x - at.x) * (end.y - at.y);
            const float area = texels / (extent.x * extent.y) * centre_weight(k, (at + end - 2.0 * middle) / extent);
            if (texels > 0.0) weigh_part(e, k, part[x] / texels, at, end, area);
            part[x] = Means(0.0);
        }
    }
}

#endif
