// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"

#include "base/error.h"

#include <array>
#include <functional>

namespace gnomon::gpu {

class GpuRefusal : public DeviceTest {
protected:
    /// What the programmer is told; fails where nothing is refused.
    static std::string refusal(const std::function<void(PassList&)>& build)
    {
        PassList list(device());
        try {
            build(list);
            device().submit(std::move(list));
        } catch (const std::logic_error& e) {
            return e.what();
        }
        ADD_FAILURE() << "nothing was refused";
        return {};
    }
    static void expect_words(const std::string& text, std::initializer_list<const char*> words)
    {
        for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
    }
    static ComputePass twice(std::vector<Binding> bindings)
    {
        return {"double", &device().compute_program("tests/gpu/twice.comp"), std::move(bindings), uint32_t(1), {1, 1, 1}};
    }
    static BufferId scratch(PassList& list) { return list.transient(BufferDesc{64, 0, Memory::device, "scratch"}); }
    static ImageId picture(PassList& list, uint32_t layers = 1, uint32_t mips = 1)
    {
        return list.transient({VK_FORMAT_R32_SFLOAT, {4, 4}, layers, mips, VK_SAMPLE_COUNT_1_BIT, false, "picture"});
    }
};

TEST_F(GpuRefusal, MissingBinding)
{
    expect_words(refusal([](PassList& l) { l.compute(twice({{scratch(l), Use::store}})); }), {"double", "twice.comp", "binding 1", "Out"});
}

TEST_F(GpuRefusal, SurplusBinding)
{
    expect_words(refusal([](PassList& l) {
        l.compute(twice({{scratch(l), Use::load}, {scratch(l), Use::store}, {scratch(l), Use::load}}));
    }),
        {"double", "twice.comp", "binding 2"});
}

TEST_F(GpuRefusal, WrongKindOfBinding)
{
    expect_words(refusal([](PassList& l) {
        l.compute(twice({{picture(l), Use::sample}, {scratch(l), Use::store}}));
    }),
        {"double", "twice.comp", "binding 0", "storage buffer", "sampled image"});
}

TEST_F(GpuRefusal, WrongSizeOfConstants)
{
    expect_words(refusal([](PassList& l) {
        ComputePass pass = twice({{scratch(l), Use::load}, {scratch(l), Use::store}});
        pass.constants = uint64_t(1);
        l.compute(std::move(pass));
    }),
        {"double", "twice.comp", "8 bytes", "4"});
}

TEST_F(GpuRefusal, WrongLayersAndForeignIds)
{
    const Program* program = &device().compute_program("tests/gpu/sum_mip.comp");
    expect_words(refusal([&](PassList& l) {
        l.compute({"mip", program, {{picture(l, 3), Use::sample}, {picture(l), Use::store}}});
    }),
        {"mip", "binding 0", "3", "layers("});
    expect_words(refusal([&](PassList& l) {
        l.compute({"mip", program, {Binding(picture(l), Use::sample).mips(1, 1), {picture(l), Use::store}}});
    }),
        {"binding 0", "mips"});
    expect_words(refusal([&](PassList& l) {
        l.compute({"mip", program, {{ImageId{77}, Use::sample}, {picture(l), Use::store}}});
    }),
        {"binding 0", "import"});
}

TEST_F(GpuRefusal, ReadBeforeWritten)
{
    expect_words(refusal([](PassList& l) {
        l.compute(twice({{scratch(l), Use::load}, {scratch(l), Use::store}}));
    }),
        {"double", "scratch", "before anything wrote"});
    const Program* program = &device().compute_program("tests/gpu/sum_mip.comp");
    expect_words(refusal([&](PassList& l) {
        l.compute({"mip", program, {{picture(l), Use::sample}, {picture(l), Use::store}}});
    }),
        {"mip", "picture", "before anything wrote"});
}

TEST_F(GpuRefusal, ReadAndWriteOfOneMip)
{
    const Program* program = &device().compute_program("tests/gpu/sum_mip.comp");
    expect_words(refusal([&](PassList& l) {
        const ImageId p = picture(l);
        l.clear(p, {});
        l.compute({"mip", program, {{p, Use::sample}, {p, Use::store}}});
    }),
        {"mip", "picture", "same layer and mip"});
}

TEST_F(GpuRefusal, ARefusedListLeavesStatesTrue)
{
    Image kept = image("kept", VK_FORMAT_R32_SFLOAT, {4, 4});
    const Program* program = &device().compute_program("tests/gpu/sum_mip.comp");
    refusal([&](PassList& l) {
        l.clear(l.import(kept), {{3.0f, 0, 0, 0}});
        l.compute({"mip", program, {{picture(l), Use::sample}, {l.import(kept), Use::store}}});
    });
    EXPECT_EQ(kept.state().parts[0].layout, VK_IMAGE_LAYOUT_UNDEFINED);
    PassList list(device());
    list.clear(list.import(kept), {{4.0f, 0, 0, 0}});
    device().submit(std::move(list));
    EXPECT_EQ(device().read_back(kept).at(0, 0), 4.0f);
}

TEST_F(GpuRefusal, UploadInsideADrawFunction)
{
    Image target = image("target", VK_FORMAT_R8G8B8A8_UNORM, {4, 4});
    Buffer numbers = storage<uint32_t>("numbers", 4);
    expect_words(refusal([&](PassList& l) {
        RasterPass pass;
        pass.name = "draws";
        pass.program = &device().raster_program("shaders/fullscreen.vert", "tests/gpu/flat.frag");
        pass.constants = std::array<float, 4>{};
        pass.colors.emplace_back().image = l.import(target);
        pass.draw = [&](Encoder&) { device().read_back(numbers); };
        l.raster(std::move(pass));
    }),
        {"numbers", "while a pass list is being recorded"});
}

TEST_F(GpuRefusal, UnknownDeviceNamesThePresentOnes)
{
    try {
        Device::open({"no such device", false});
        FAIL();
    } catch (const base::Error& e) {
        expect_words(e.what(), {"no such device", device().info().name.c_str()});
    }
}

} // namespace gnomon::gpu
