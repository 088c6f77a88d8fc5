// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands.h"
#include "gpu/device.h"

#include <memory>

namespace gnomon::cli {

std::unique_ptr<gpu::Device> open_device(const Common&);

/// Throws base::Error with the first validation error, if any came.
void demand_valid(const gpu::Device&);

} // namespace gnomon::cli
