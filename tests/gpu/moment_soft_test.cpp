// SPDX-License-Identifier: Apache-2.0
// Moment soft shadow mapping as a whole, where visibility has a closed form, and where its input is bad.
#include "soft_fixture.h"

extern const gnomon::shadow::TechniqueInfo technique_moment_soft;

namespace gnomon {
namespace {

class MomentSoft : public gpu::SoftTest { };

TEST_F(MomentSoft, HalfPlanesAreRampsWithinATexel)
{
    // the penumbra is 0.3 m wide, a texel of the face 1.25 tan(45) 2 * 5 / 1024 = 0.012 m on the floor
    for (const double grid : {1.0, 2.0, 3.0, 8.0})
        EXPECT_LE(half_plane_error(
                      technique_moment_soft, "rect,position=0/5/0,target=0/0/0,width=1.2,height=1.2", {{"grid", grid}, {"contact", 0}}),
            1.5 * 0.012 / 0.3)
            << "grid " << grid;
}

TEST_F(MomentSoft, KernelsForDisksOfTheirAreaAreNearerThanThoseAroundThem)
{
    expect_ramps_before_disks(technique_moment_soft, 0.015, {{"contact", 0}}); // half a texel of a penumbra of 0.4 m
}

TEST_F(MomentSoft, LightsWithoutASizeCastHardShadows) { expect_hard_shadows(technique_moment_soft, {}); }

TEST_F(MomentSoft, BadInputGivesFractions)
{
    std::vector<Values> ways;
    for (const double sums : {0.0, 1.0})
        for (const auto& [bias, grid] : {std::pair(0.0, 1.0), std::pair(10000.0, 3.0)})
            ways.push_back({{"sums", sums}, {"moment_bias", bias}, {"grid", grid}});
    expect_fractions(technique_moment_soft, ways);
}

} // namespace
} // namespace gnomon
