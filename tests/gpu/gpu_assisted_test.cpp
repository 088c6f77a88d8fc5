// SPDX-License-Identifier: Apache-2.0
// The check that `./dev robustness` makes of every technique, shown to be one that can fail.
#include "device_fixture.h"

#include <algorithm>

namespace gnomon::gpu {

TEST(GpuAssisted, AWriteBeyondABufferIsSeen)
{
    ::setenv("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT", 1); // read when the instance is made
    const auto device = Device::open({.validation = true});
    ::unsetenv("VK_LAYER_ENABLES");
    const auto write = [&](uint32_t count) {
        Buffer in = device->buffer({64 * 16, 0, Memory::device, "in"}), out = device->buffer({64 * 16, 0, Memory::device, "out"});
        PassList list(*device);
        list.fill(list.import(in), 0);
        list.compute({"write", &device->compute_program("tests/gpu/twice.comp"),
            {{list.import(in), Use::load}, {list.import(out), Use::store}}, count, {count, 1, 1}});
        device->submit(std::move(list));
        return device->validation_errors();
    };
    ASSERT_EQ(write(64), std::vector<std::string>());
    const std::vector<std::string> errors = write(65);
    EXPECT_TRUE(std::any_of(errors.begin(), errors.end(), [](const auto& e) { return e.find("out of bounds") != std::string::npos; }))
        << errors.size() << (errors.empty() ? "" : errors[0]);
}

} // namespace gnomon::gpu
