// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"

#include <stdexcept>

namespace gnomon::gpu {
namespace {

class Patches : public DeviceTest { };

struct Four {
    uint32_t values[4];
};

ComputePass write_constants(PassList& list, Buffer& out, const Constants& constants)
{
    return {.name = "constants",
        .program = &list.device().compute_program("tests/gpu/constants.comp"),
        .bindings = {{list.import(out), Use::store}},
        .constants = constants,
        .threads = {4, 1, 1}};
}

TEST_F(Patches, TakeThePlaceOfConstantsInOrder)
{
    Buffer out = storage<uint32_t>("out", 4), again = storage<uint32_t>("again", 4), plain = storage<uint32_t>("plain", 4);
    PassList list(device());
    const BufferId written = list.transient({64, 0, Memory::device, "written"});
    list.fill(written, 7);
    Constants constants = Four{{1, 2, 3, 4}};
    constants.patches = {{written, 8, 4, 8}};
    list.compute(write_constants(list, out, constants));
    list.compute(write_constants(list, plain, Four{{5, 6, 7, 8}}));
    list.fill(written, 9); // after the first pass has taken its part
    constants.patches.push_back({written, 0, 0, 4});
    list.compute(write_constants(list, again, constants));
    device().submit(std::move(list));
    EXPECT_EQ(values<uint32_t>(out), (std::vector<uint32_t>{1, 7, 7, 4}));
    EXPECT_EQ(values<uint32_t>(plain), (std::vector<uint32_t>{5, 6, 7, 8}));
    EXPECT_EQ(values<uint32_t>(again), (std::vector<uint32_t>{9, 9, 9, 4}));
}

TEST_F(Patches, OutsideOfTheConstantsAreRefused)
{
    Buffer out = storage<uint32_t>("out", 4);
    PassList list(device());
    const BufferId written = list.transient({64, 0, Memory::device, "written"});
    for (const Constants::Patch& p :
        {Constants::Patch{written, 0, 12, 8}, {written, 0, 2, 4}, {BufferId{9}, 0, 0, 4}, {written, 64, 0, 4}}) {
        Constants constants = Four{};
        constants.patches = {p};
        EXPECT_THROW(list.compute(write_constants(list, out, constants)), std::logic_error);
    }
}

} // namespace
} // namespace gnomon::gpu
