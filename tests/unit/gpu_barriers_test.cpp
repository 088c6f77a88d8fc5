// SPDX-License-Identifier: Apache-2.0
#include "gpu/barriers.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gnomon::gpu {

namespace {

Access of(Use use, PassKind kind = PassKind::compute, bool depth = false) { return access_of(use, kind, depth); }

ImageState made(uint32_t layers = 1, uint32_t mips = 1)
{
    ImageState s;
    s.layers = layers;
    s.mips = mips;
    return s;
}

std::vector<ImageBarrier> pass(std::vector<ImageUse> uses, std::vector<ImageState>& states) { return plan_images("pass", uses, states); }

constexpr VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

} // namespace

TEST(GpuBarriers, WriteThenReadWaitsForTheWriter)
{
    BufferState s;
    EXPECT_FALSE(transition(s, of(Use::store)).needed); // nothing before it
    const Barrier b = transition(s, of(Use::load, PassKind::raster));
    EXPECT_TRUE(b.needed);
    EXPECT_EQ(b.src_stages, compute);
    EXPECT_EQ(b.src_access, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    EXPECT_EQ(b.dst_stages, VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
    EXPECT_EQ(b.dst_access, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
}

TEST(GpuBarriers, SecondReadInTheSameStageNeedsNothing)
{
    BufferState s;
    transition(s, of(Use::store));
    EXPECT_TRUE(transition(s, of(Use::load)).needed);
    EXPECT_FALSE(transition(s, of(Use::load)).needed);
    EXPECT_TRUE(transition(s, of(Use::indirect)).needed); // another stage has not seen the write
    EXPECT_FALSE(transition(s, of(Use::load)).needed);
}

TEST(GpuBarriers, WriteWaitsForAllReadersAndTheWriter)
{
    BufferState s;
    transition(s, of(Use::store));
    transition(s, of(Use::load));
    transition(s, of(Use::indirect));
    const Barrier b = transition(s, of(Use::copy_to, PassKind::transfer));
    EXPECT_TRUE(b.needed);
    EXPECT_EQ(b.src_stages, compute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT);
    EXPECT_EQ(b.src_access, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    EXPECT_EQ(b.dst_access, VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

TEST(GpuBarriers, WriteAfterWriteWaits)
{
    BufferState s;
    transition(s, of(Use::store));
    EXPECT_TRUE(transition(s, of(Use::store)).needed);
}

TEST(GpuBarriers, ReadersOfAnotherLayoutAreWaitedFor)
{
    std::vector<ImageState> states = {made()};
    pass({{0, {}, of(Use::color, PassKind::raster), "i"}}, states);
    const auto sample = pass({{0, {}, of(Use::sample, PassKind::raster), "i"}}, states);
    ASSERT_EQ(sample.size(), 1u);
    EXPECT_EQ(sample[0].barrier.old_layout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    EXPECT_EQ(sample[0].barrier.new_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    const auto load = pass({{0, {}, of(Use::load), "i"}}, states);
    ASSERT_EQ(load.size(), 1u);
    EXPECT_EQ(load[0].barrier.src_stages, VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
    EXPECT_EQ(load[0].barrier.new_layout, VK_IMAGE_LAYOUT_GENERAL);
    // A second stage that reads in the new layout chains behind the stage that waited for the transition.
    const auto again = pass({{0, {}, of(Use::load, PassKind::raster), "i"}}, states);
    ASSERT_EQ(again.size(), 1u);
    EXPECT_EQ(again[0].barrier.src_stages, compute);
}

TEST(GpuBarriers, DepthIsSampledAndTestedInOnePass)
{
    std::vector<ImageState> states = {made()};
    pass({{0, {}, of(Use::depth, PassKind::raster, true), "d"}}, states);
    std::vector<ImageUse> uses
        = {{0, {}, of(Use::sample, PassKind::raster, true), "d"}, {0, {}, of(Use::depth_test, PassKind::raster, true), "d"}};
    const auto b = plan_images("pass", uses, states);
    ASSERT_EQ(b.size(), 1u);
    EXPECT_EQ(b[0].barrier.new_layout, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
    EXPECT_EQ(b[0].barrier.dst_access, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT);
}

TEST(GpuBarriers, MipChainIsTrackedPerMip)
{
    std::vector<ImageState> states = {made(1, 4)};
    pass({{0, {0, 1, 0, 1}, of(Use::store), "chain"}}, states);
    for (uint32_t mip = 1; mip < 4; ++mip) {
        const auto b = pass({{0, {0, 1, mip - 1, 1}, of(Use::sample), "chain"}, {0, {0, 1, mip, 1}, of(Use::store), "chain"}}, states);
        ASSERT_EQ(b.size(), 2u) << mip;
        EXPECT_EQ(b[0].range, (Range{0, 1, mip - 1, 1}));
        EXPECT_EQ(b[0].barrier.old_layout, VK_IMAGE_LAYOUT_GENERAL);
        EXPECT_EQ(b[1].range, (Range{0, 1, mip, 1}));
        EXPECT_EQ(b[1].barrier.old_layout, VK_IMAGE_LAYOUT_UNDEFINED);
    }
    EXPECT_EQ(states[0].parts.size(), 4u);
    // Sampling all: only the last mip has to change, and then the image is uniform again.
    const auto b = pass({{0, {0, 1, 0, 4}, of(Use::sample), "chain"}}, states);
    ASSERT_EQ(b.size(), 1u);
    EXPECT_EQ(b[0].range, (Range{0, 1, 3, 1}));
    EXPECT_EQ(states[0].parts.size(), 1u);
}

TEST(GpuBarriers, EqualPartsAreOneBarrier)
{
    std::vector<ImageState> states = {made(6, 3)};
    pass({{0, {2, 2, 0, 3}, of(Use::store), "cube"}}, states);
    const auto b = pass({{0, {2, 2, 0, 3}, of(Use::sample), "cube"}}, states);
    ASSERT_EQ(b.size(), 1u);
    EXPECT_EQ(b[0].range, (Range{2, 2, 0, 3}));
}

TEST(GpuBarriers, TwoReadsMeetInGeneral)
{
    std::vector<ImageState> states = {made()};
    pass({{0, {}, of(Use::store), "i"}}, states);
    std::vector<ImageUse> uses = {{0, {}, of(Use::sample), "i"}, {0, {}, of(Use::load), "i"}};
    plan_images("pass", uses, states);
    EXPECT_EQ(uses[0].access.layout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(uses[1].access.layout, VK_IMAGE_LAYOUT_GENERAL);
}

TEST(GpuBarriers, MisuseIsNamed)
{
    std::vector<ImageState> states = {made(1, 2)};
    EXPECT_THROW(pass({{0, {0, 1, 0, 2}, of(Use::sample), "i"}}, states), std::logic_error); // nothing wrote it
    pass({{0, {0, 1, 0, 2}, of(Use::store), "i"}}, states);
    try {
        pass({{0, {0, 1, 0, 2}, of(Use::sample), "twin"}, {0, {0, 1, 1, 1}, of(Use::store), "twin"}}, states);
        FAIL();
    } catch (const std::logic_error& e) {
        EXPECT_NE(std::string(e.what()).find("'pass'"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find("'twin'"), std::string::npos);
    }
}

TEST(GpuBarriers, OneBarrierForABufferUsedTwice)
{
    std::vector<BufferState> states(1);
    const std::vector<BufferUse> write = {{0, of(Use::store)}};
    plan_buffers(write, states);
    const std::vector<BufferUse> read = {{0, of(Use::load)}, {0, of(Use::indirect)}};
    const auto b = plan_buffers(read, states);
    ASSERT_EQ(b.size(), 1u);
    EXPECT_EQ(b[0].barrier.dst_stages, compute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT);
}

} // namespace gnomon::gpu
