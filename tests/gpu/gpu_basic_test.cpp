// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "glsl_function.h"

#include "base/error.h"

namespace gnomon::gpu {

class GpuBasic : public DeviceTest { };

TEST_F(GpuBasic, ComputeWritesABuffer)
{
    std::vector<Vec4> inputs;
    for (int i = 0; i < 1000; ++i) inputs.push_back({float(i), -float(i), 0.5f, 1.0f});
    const auto outputs = run_glsl_function(device(), "tests/gpu/twice.comp", inputs);
    ASSERT_EQ(outputs.size(), inputs.size());
    for (size_t i = 0; i < inputs.size(); ++i)
        for (size_t c = 0; c < 4; ++c) ASSERT_EQ(outputs[i][c], 2.0f * inputs[i][c]) << i;
}

TEST_F(GpuBasic, FullscreenGradientComesBack)
{
    Image target = image("gradient", VK_FORMAT_R32G32B32A32_SFLOAT, {37, 19});
    PassList list(device());
    list.group("common");
    const struct {
        float width, height, blue;
    } constants{37, 19, 0.25f};
    ColorTarget color;
    color.image = list.import(target);
    list.fullscreen({"gradient", &device().raster_program("shaders/fullscreen.vert", "tests/gpu/gradient.frag"), {}, constants, {color}});
    const Submitted done = device().submit(std::move(list));
    ASSERT_EQ(done.times.size(), 1u);
    EXPECT_EQ(done.times[0].name, "common/gradient");
    EXPECT_GT(done.times[0].ms, 0.0);
    const base::Picture picture = device().read_back(target);
    for (int y = 0; y < 19; ++y)
        for (int x = 0; x < 37; ++x) {
            ASSERT_NEAR(picture.at(x, y, 0), (float(x) + 0.5f) / 37.0f, 1e-6f);
            ASSERT_NEAR(picture.at(x, y, 1), (float(y) + 0.5f) / 19.0f, 1e-6f);
            ASSERT_EQ(picture.at(x, y, 2), 0.25f);
        }
}

TEST_F(GpuBasic, DispatchesTakeThreadsWithASpecialisedGroup)
{
    const SpecConstant size{3, 16};
    const Program& program = device().compute_program("tests/gpu/local_size.comp", std::span(&size, 1));
    EXPECT_EQ(program.local_size, (std::array<uint32_t, 3>{16, 2, 1}));
    Buffer count = storage<uint32_t>("count", 1);
    PassList list(device());
    const BufferId id = list.import(count);
    list.fill(id, 0);
    list.compute({"count", &program, {{id, Use::update}}, {}, {17, 3, 1}});
    device().submit(std::move(list));
    EXPECT_EQ(values<uint32_t>(count)[0], 2u * 2u * 32u); // 17 x 3 threads are 2 x 2 groups
}

TEST_F(GpuBasic, SameRequestIsTheSameProgram)
{
    const Program& a = device().compute_program("tests/gpu/twice.comp");
    EXPECT_EQ(&a, &device().compute_program("tests/gpu/twice.comp"));
    EXPECT_EQ(a.constants_bytes, 4u);
    EXPECT_EQ(a.local_size[0], 64u);
}

TEST_F(GpuBasic, UnknownShaderNamesNearOnes)
{
    try {
        device().compute_program("tests/gpu/twicce.comp");
        FAIL();
    } catch (const std::logic_error& e) {
        EXPECT_NE(std::string(e.what()).find("tests/gpu/twice.comp"), std::string::npos) << e.what();
    }
}

TEST_F(GpuBasic, UploadsComeBack)
{
    Image target = image("texels", VK_FORMAT_R8G8B8A8_SRGB, {3, 2});
    std::vector<std::byte> texels;
    for (int i = 0; i < 24; ++i) texels.push_back(std::byte(i * 10));
    device().upload(target, texels);
    EXPECT_EQ(device().read_back_bytes(target), texels);
    const base::Picture picture = device().read_back(target);
    EXPECT_NEAR(picture.at(1, 1, 0), std::pow((160.0f / 255.0f + 0.055f) / 1.055f, 2.4f), 1e-6f);
    EXPECT_NEAR(picture.at(1, 1, 3), 190.0f / 255.0f, 1e-6f); // alpha is linear
}

TEST_F(GpuBasic, TooLargeAnImageIsRefusedWithASentence)
{
    try {
        image("huge", VK_FORMAT_R32G32B32A32_SFLOAT, {16384, 16384}, 2000);
        FAIL();
    } catch (const base::Error& e) {
        EXPECT_NE(std::string(e.what()).find("huge"), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("choose a smaller"), std::string::npos) << e.what();
    }
}

TEST_F(GpuBasic, MemoryIsGivenBack)
{
    const uint64_t before = device().allocated_bytes();
    {
        const Image a = image("a", VK_FORMAT_R32_SFLOAT, {256, 256});
        const Buffer b = storage<float>("b", 1 << 20);
        EXPECT_GE(device().allocated_bytes(), before + (256 * 256 + (1 << 20)) * 4);
    }
    EXPECT_EQ(device().allocated_bytes(), before);
}

} // namespace gnomon::gpu
