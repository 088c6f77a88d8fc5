// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon::gpu {

/// A device with validation, opened once a suite; every test fails on a validation message. GNOMON_TEST_DEVICE chooses the device by a
/// part of its name.
class DeviceTest : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        const char* name = std::getenv("GNOMON_TEST_DEVICE");
        device_ = Device::open({name ? name : "", true});
    }
    static void TearDownTestSuite() { device_.reset(); }
    void SetUp() override { seen_ = device().validation_errors().size(); }
    void TearDown() override
    {
        const auto& errors = device().validation_errors();
        for (size_t i = seen_; i < errors.size(); ++i) ADD_FAILURE() << errors[i];
    }

    static Device& device() { return *device_; }

    template <class T> static Buffer storage(const char* name, std::span<const T> values)
    {
        Buffer b = device().buffer({values.size_bytes(), 0, Memory::device, name});
        device().upload(b, std::as_bytes(values));
        return b;
    }
    template <class T> static Buffer storage(const char* name, size_t count)
    {
        return device().buffer({count * sizeof(T), 0, Memory::device, name});
    }
    template <class T> static std::vector<T> values(Buffer& b)
    {
        const std::vector<std::byte> bytes = device().read_back(b);
        std::vector<T> out(bytes.size() / sizeof(T));
        std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
        return out;
    }
    static Image image(const char* name, VkFormat format, Size size, uint32_t layers = 1, uint32_t mips = 1)
    {
        return device().image({format, size, layers, mips, VK_SAMPLE_COUNT_1_BIT, false, name});
    }

private:
    inline static std::unique_ptr<Device> device_;
    size_t seen_ = 0;
};

} // namespace gnomon::gpu
