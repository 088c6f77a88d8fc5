// SPDX-License-Identifier: Apache-2.0
// Variance soft shadow mapping as a whole, where visibility has a closed form, and where its input is bad.
#include "soft_fixture.h"

extern const gnomon::shadow::TechniqueInfo technique_vssm;

namespace gnomon {
namespace {

class Vssm : public gpu::SoftTest { };

TEST_F(Vssm, HalfPlanesAreRampsWithinATexel)
{
    // the penumbra is 0.3 m wide, a texel of the face 1.25 tan(45) 2 * 5 / 1024 = 0.012 m on the floor
    const char* light = "rect,position=0/5/0,target=0/0/0,width=1.2,height=1.2";
    for (const double subdivision : {0.0, 1.0, 2.0, 3.0})
        for (const double bound : {0.0, 1.0}) {
            if (bound == 0.0 && subdivision != 3.0) continue; // one way of dividing stands for all
            EXPECT_LE(half_plane_error(technique_vssm, light, {{"subdivision", subdivision}, {"bound", bound}, {"contact", 0}}),
                1.5 * 0.012 / 0.3)
                << "subdivision " << subdivision << ", bound " << bound;
        }
}

TEST_F(Vssm, KernelsForDisksOfTheirAreaAreNearerThanThoseAroundThem)
{
    expect_ramps_before_disks(technique_vssm, 0.015, {{"contact", 0}}); // half a texel of a penumbra of 0.4 m
}

TEST_F(Vssm, LightsWithoutASizeCastHardShadows) { expect_hard_shadows(technique_vssm, {}); }

TEST_F(Vssm, BadInputGivesFractions)
{
    std::vector<Values> ways;
    for (const double sums : {0.0, 1.0})
        for (const double deviation : {0.0, 0.1})
            ways.push_back({{"sums", sums}, {"min_deviation", deviation}, {"flat_deviation", deviation}});
    expect_fractions(technique_vssm, ways);
}

} // namespace
} // namespace gnomon
