// SPDX-License-Identifier: Apache-2.0
#include "host/device.h"

#include "gpu/functions.h"
#include "host/result.h"

#include <algorithm>

namespace gnomon::host {

Device::Device(const gnomon_device_info& info)
{
    constexpr uint32_t step = GNOMON_VERSION_MAJOR == 0 ? 100 : 10000;
    if (info.version / step != GNOMON_VERSION / step)
        refuse(GNOMON_ERROR_ARGUMENT,
            "the program was built for Gnomon {}.{} and this library is {}.{}; build it against this library's headers",
            info.version / 10000, info.version / 100 % 100, GNOMON_VERSION_MAJOR, GNOMON_VERSION_MINOR);
    if (!info.get_instance_proc_addr || !info.instance || !info.physical_device || !info.device)
        refuse(GNOMON_ERROR_ARGUMENT,
            "gnomon_device_info lacks a handle: get_instance_proc_addr, instance, physical_device and device are needed");
    gpu::AdoptedDevice given{info.instance, info.physical_device, info.device, VK_NULL_HANDLE, info.queue_family,
        info.get_instance_proc_addr, {}, info.pipeline_cache, false};
    for (uint32_t i = 0; i < info.extension_count; ++i) given.enabled_extensions.emplace_back(info.extensions[i]);
    try {
        gpu = gpu::Device::adopt(given);
    } catch (const gpu::OutOfMemory&) {
        throw;
    } catch (const base::Error& e) {
        throw Refusal(GNOMON_ERROR_UNSUPPORTED, e.what());
    }
}

void Device::retire(uint64_t ticket)
{
    for (ticket = std::min(ticket, recorded); retired < ticket;) gpu->retire(++retired);
}

} // namespace gnomon::host
