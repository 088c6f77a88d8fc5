// SPDX-License-Identifier: Apache-2.0
// Running sums along x of every row of an array image, written transposed and with a zero before them: entry (y, i) is the sum of
// the first i texels of row y. Two such passes make a summed-area table. The includer defines VALUE (vec4 or uvec4), `VALUE
// load(ivec3)` and `void store(ivec3, VALUE)`.
//
// One subgroup takes a row and carries its sum from one run of texels to the next, so there is no barrier and no shared memory, which
// lavapipe pays dearly for (120 ms for a table of 1024 x 1024 RGBA32F, against 20 ms here); any subgroup size will do. Transposed, because
// a scan that reads down the columns takes 1.8 times as long as one along the rows.
#ifndef GNOMON_SUMMED_AREA_SCAN_GLSL
#define GNOMON_SUMMED_AREA_SCAN_GLSL
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(constant_id = 0) const int channels = 4;

const int rows_per_group = 8;
layout(local_size_x = 256) in; // summed_area_table.cpp asks for 32 = 256 / 8 threads a row

// Of the channels there are: the scans, and what load() computes, are the greater part of the work.
VALUE scanned(VALUE v)
{
    VALUE sum = VALUE(0);
    sum.x = subgroupInclusiveAdd(v.x);
    if (channels > 1) sum.y = subgroupInclusiveAdd(v.y);
    if (channels > 2) sum.zw = subgroupInclusiveAdd(v.zw);
    return sum;
}

void scan_rows(ivec2 size)
{
    // Not gl_SubgroupSize: a driver may leave lanes of a subgroup out.
    const uvec4 present = subgroupBallot(true);
    const int lanes = int(subgroupBallotBitCount(present)), lane = int(subgroupBallotExclusiveBitCount(present));
    const uint last = subgroupMax(gl_SubgroupInvocationID);
    const int first = int(gl_WorkGroupID.x) * rows_per_group, layer = int(gl_WorkGroupID.y);
    const int end = min(first + rows_per_group, size.y);
    for (int y = first + int(gl_SubgroupID); y < end; y += int(gl_NumSubgroups)) {
        if (lane == 0) store(ivec3(y, 0, layer), VALUE(0));
        VALUE before = VALUE(0);
        for (int start = 0; start < size.x; start += lanes) {
            const int x = start + lane;
            const VALUE value = x < size.x ? load(ivec3(x, y, layer)) : VALUE(0);
            const VALUE sum = before + scanned(value);
            if (x < size.x) store(ivec3(y, x + 1, layer), sum);
            before = subgroupBroadcast(sum, last);
        }
    }
}

#endif
