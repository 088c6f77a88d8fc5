// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"

#include <gnomon/gnomon.h>

#include <memory>

namespace gnomon::host {

/// Lives until the last object made with it: the host destroys them in any order.
struct Device {
    explicit Device(const gnomon_device_info&);

    void retire(uint64_t ticket); ///< and all before it

    std::unique_ptr<gpu::Device> gpu;
    uint64_t retired = 0, recorded = 0; ///< tickets are counted from 1
};

} // namespace gnomon::host

struct gnomon_device_t {
    std::shared_ptr<gnomon::host::Device> device;
};
