// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "shadow/technique.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

namespace gnomon {

/// Tests of each of some techniques, on a device whose validation layers are to stay silent.
template <class Suite> class TechniqueSuite : public testing::TestWithParam<const shadow::TechniqueInfo*> {
protected:
    static void SetUpTestSuite()
    {
        const char* name = std::getenv("GNOMON_DEVICE");
        device_ = gpu::Device::open({.name = name ? name : "", .validation = true});
    }
    static void TearDownTestSuite() { device_.reset(); }
    void SetUp() override { seen_ = device_->validation_errors().size(); }
    void TearDown() override
    {
        const auto& errors = device_->validation_errors();
        for (size_t i = seen_; i < errors.size(); ++i) ADD_FAILURE() << errors[i];
    }

    inline static std::unique_ptr<gpu::Device> device_; ///< one for each suite
    size_t seen_ = 0;
};

} // namespace gnomon
