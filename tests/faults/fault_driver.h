// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

// A layer between Gnomon and the driver that fails chosen calls and counts what lives.
namespace gnomon::tests {

/// Which call fails, counted over all calls of `among` from `arm` on. A lost device stays lost: every later call of submit or wait says so.
struct Fault {
    enum class Among : uint8_t {
        none, ///< all calls reach the driver
        all, ///< whatever may be out of memory
        queue, ///< submissions and waits
    } among
        = Among::none;
    uint64_t at = 0; ///< the first is 0
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
};

/// State of the layer. Vulkan's functions carry no data of ours, so there is one of it in a process.
class FaultDriver {
public:
    static FaultDriver& get();
    void arm(const Fault&);
    uint64_t calls() const { return calls_; } ///< of the armed kind since `arm`; with Among::none, of Among::all
    const std::string& failed() const { return failed_; } ///< the call that was failed; "" = none yet
    int64_t live() const; ///< handles made and not destroyed, all kinds
    std::string living() const; ///< "vkCreateBuffer 2, ..." of those; "" = none
    void forget(); ///< what lives

    // Called by the wrappers.
    VkResult before(const char* name, bool queue);
    void made(const char* name) { ++live_[name]; }
    void destroyed(const char* name) { --live_[name]; }

private:
    Fault fault_;
    uint64_t calls_ = 0;
    bool lost_ = false;
    std::string failed_;
    std::map<std::string, int64_t> live_;
};

/// A device whose calls go through the layer. `below` is a device of Gnomon's own, with validation, that owns all handles.
std::unique_ptr<gpu::Device> adopt_with_faults(const gpu::Device& below);

} // namespace gnomon::tests
