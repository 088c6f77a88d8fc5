// SPDX-License-Identifier: Apache-2.0
#include "gpu/memory.h"

#include <gtest/gtest.h>

#include <random>

namespace gnomon::gpu {

TEST(GpuMemory, RangesAreAlignedAndApart)
{
    Ranges r(1024);
    EXPECT_EQ(r.take(10, 1), 0u);
    EXPECT_EQ(r.take(100, 256), 256u);
    EXPECT_EQ(r.take(200, 16), 16u); // the gap before an aligned range stays usable
    EXPECT_EQ(r.take(1000, 1), std::nullopt);
    EXPECT_FALSE(r.unused());
}

TEST(GpuMemory, NeighboursJoin)
{
    Ranges r(300);
    const auto a = r.take(100, 1), b = r.take(100, 1), c = r.take(100, 1);
    r.give(*a, 100);
    r.give(*c, 100);
    EXPECT_EQ(r.take(200, 1), std::nullopt);
    r.give(*b, 100);
    EXPECT_TRUE(r.unused());
    EXPECT_EQ(r.take(300, 1), 0u);
}

TEST(GpuMemory, RandomUseNeverOverlapsAndEndsWhole)
{
    std::mt19937 random(7);
    Ranges r(4096);
    std::vector<std::pair<uint64_t, uint64_t>> live;
    std::vector<bool> taken(4096, false);
    for (int i = 0; i < 5000; ++i) {
        if (live.empty() || random() % 2) {
            const uint64_t size = 1 + random() % 200, alignment = uint64_t(1) << random() % 7;
            const auto offset = r.take(size, alignment);
            if (!offset) continue;
            ASSERT_EQ(*offset % alignment, 0u);
            ASSERT_LE(*offset + size, 4096u);
            for (uint64_t k = *offset; k < *offset + size; ++k) {
                ASSERT_FALSE(taken[k]);
                taken[k] = true;
            }
            live.emplace_back(*offset, size);
        } else {
            const size_t which = random() % live.size();
            const auto [offset, size] = live[which];
            live.erase(live.begin() + long(which));
            for (uint64_t k = offset; k < offset + size; ++k) taken[k] = false;
            r.give(offset, size);
        }
    }
    for (const auto& [offset, size] : live) r.give(offset, size);
    EXPECT_TRUE(r.unused());
}

} // namespace gnomon::gpu
