// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/functions.h"

#include <string>
#include <vector>

namespace gnomon::gpu {

/// An instance of our own, with the validation layer on request. The address of `errors` must not move: the messenger writes there.
class Instance {
public:
    explicit Instance(bool validation);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle = VK_NULL_HANDLE;
    InstanceFunctions vk;
    std::vector<std::string> errors; ///< ERROR severity and VALIDATION type, each text once
    bool surface = false; ///< VK_KHR_surface is on: swapchains can be had
    std::vector<VkPhysicalDevice> devices() const; ///< not empty; throws base::Error

private:
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

} // namespace gnomon::gpu
