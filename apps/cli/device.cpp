// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"

namespace gnomon::cli {

std::unique_ptr<gpu::Device> open_device(const Common& common) { return gpu::Device::open({common.device, common.validation}); }

void demand_valid(const gpu::Device& device)
{
    const auto& errors = device.validation_errors();
    if (!errors.empty()) base::fail("the validation layers found {} errors, the first: {}", errors.size(), errors.front());
}

} // namespace gnomon::cli
