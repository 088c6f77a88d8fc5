// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"

namespace gnomon::gpu {

class GpuImages : public DeviceTest {
protected:
    /// R32F, 16 x 16, five mips, mip 0 all ones.
    static Image ones()
    {
        Image chain = image("chain", VK_FORMAT_R32_SFLOAT, {16, 16}, 1, 5);
        const std::vector<float> texels(256, 1.0f);
        device().upload(chain, std::as_bytes(std::span(texels)));
        return chain;
    }
    static void expect_sums(Image& chain)
    {
        for (uint32_t mip = 0; mip < 5; ++mip) {
            const base::Picture p = device().read_back(chain, 0, mip);
            ASSERT_EQ(p.size.width, 16 >> mip);
            for (const float v : p.values) ASSERT_EQ(v, float(1 << (2 * mip))) << mip;
        }
    }
};

TEST_F(GpuImages, MipChainInOneListByCompute)
{
    Image chain = ones();
    PassList list(device());
    const ImageId id = list.import(chain);
    for (uint32_t mip = 1; mip < 5; ++mip) {
        const uint32_t size = 16u >> mip;
        list.compute({"mip", &device().compute_program("tests/gpu/sum_mip.comp"),
            {Binding(id, Use::sample).mips(mip - 1, 1), Binding(id, Use::store).mips(mip, 1)}, {}, {size, size, 1}});
    }
    device().submit(std::move(list));
    expect_sums(chain);
}

TEST_F(GpuImages, MipChainInOneListByRaster)
{
    Image chain = ones();
    PassList list(device());
    const ImageId id = list.import(chain);
    for (uint32_t mip = 1; mip < 5; ++mip) {
        ColorTarget below;
        below.image = id;
        below.mip = mip;
        list.fullscreen({"mip", &device().raster_program("shaders/fullscreen.vert", "tests/gpu/sum_mip.frag"),
            {Binding(id, Use::sample).mips(mip - 1, 1)}, {}, {below}});
    }
    device().submit(std::move(list));
    expect_sums(chain);
}

TEST_F(GpuImages, GeneratedMipsAreMeansAndTheTableReadsThem)
{
    std::vector<Image> images;
    for (int i = 0; i < 3; ++i) {
        images.push_back(image("texture", VK_FORMAT_R8G8B8A8_UNORM, {4, 4}, 1, 3));
        std::vector<std::byte> texels(64);
        for (size_t k = 0; k < 64; ++k) texels[k] = std::byte(k % 8 < 4 ? 40 * (i + 1) : 0); // columns alternate
        device().upload(images.back(), texels);
        device().generate_mips(images.back());
        EXPECT_NEAR(device().read_back(images.back(), 0, 2).at(0, 0, 1), 20.0f * float(i + 1) / 255.0f, 1.0f / 255.0f);
    }
    const std::vector<const Image*> list_of_images = {&images[0], &images[1], &images[2]};
    const std::vector<Sampler> samplers(3, Sampler::linear_repeat);
    const TextureTable table = device().texture_table(list_of_images, samplers);
    Buffer seen = storage<float>("seen", 24);
    PassList list(device());
    ComputePass pass{"table", &device().compute_program("tests/gpu/table.comp"), {{list.import(seen), Use::store}}, {}, {6, 1, 1}};
    pass.textures = &table;
    list.compute(std::move(pass));
    device().submit(std::move(list));
    const auto colors = values<float>(seen);
    for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(colors[4 * i], 20.0f * float(i % 3 + 1) / 255.0f, 1.0f / 255.0f) << i;
}

TEST_F(GpuImages, ClearsAndCopies)
{
    Image from = image("from", VK_FORMAT_R32G32_SFLOAT, {8, 4}, 2), to = image("to", VK_FORMAT_R32G32_SFLOAT, {8, 4}, 2);
    PassList list(device());
    list.clear(list.import(from), {{0.5f, -2.0f, 0, 0}});
    list.copy(list.import(from), list.import(to));
    list.group("ours");
    const BufferId numbers = list.transient(BufferDesc{64, 0, Memory::device, "numbers"});
    list.group("");
    list.transient(BufferDesc{32, 0, Memory::device, "others"});
    Buffer out = storage<uint32_t>("out", 4);
    list.fill(numbers, 7);
    list.copy(numbers, list.import(out), 16);
    const Submitted done = device().submit(std::move(list));
    EXPECT_EQ(done.times.size(), 4u);
    EXPECT_EQ(done.transient_bytes, 96u);
    EXPECT_EQ(done.group_bytes, (std::map<std::string, uint64_t>{{"ours", 64}}));
    EXPECT_EQ(device().read_back(to, 1).at(7, 3, 1), -2.0f);
    EXPECT_EQ(values<uint32_t>(out), std::vector<uint32_t>(4, 7));
}

TEST_F(GpuImages, DepthClearsAsAnImage)
{
    Image depth = image("depth", VK_FORMAT_D32_SFLOAT, {4, 4});
    PassList list(device());
    list.clear(list.import(depth), {{0.75f, 0, 0, 0}});
    device().submit(std::move(list));
    EXPECT_EQ(device().read_back(depth).at(3, 3), 0.75f);
}

TEST_F(GpuImages, TransientsAreUsedAgain)
{
    uint64_t after_first = 0;
    for (int i = 0; i < 4; ++i) {
        PassList list(device());
        list.clear(list.transient({VK_FORMAT_R32_SFLOAT, {64, 64}, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "scratch"}), {});
        EXPECT_GE(device().submit(std::move(list)).transient_bytes, 64u * 64 * 4);
        if (i == 0) after_first = device().allocated_bytes();
    }
    EXPECT_EQ(device().allocated_bytes(), after_first);
}

} // namespace gnomon::gpu
