// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/casters.h"
#include "shadow/gbuffer.h"

#include <vector>

namespace gnomon::host {

/// The host's images for the length of one recorded list, and the layouts in which they are to be left.
class HostImages {
public:
    explicit HostImages(gpu::Device& device)
        : device_(device)
    {
    }
    HostImages(const HostImages&) = delete;
    HostImages& operator=(const HostImages&) = delete;

    /// Throws Refusal, naming the image, where it cannot be what it is for. `content`: it is read.
    gpu::ImageId import(gpu::PassList&, const gnomon_image&, const char* name, bool content);
    std::span<const gpu::ImageLayout> layouts() const { return layouts_; }

private:
    gpu::Device& device_;
    std::vector<std::unique_ptr<gpu::Image>> images_; ///< lists keep references
    std::vector<gpu::ImageLayout> layouts_;
};

/// The G-buffer that techniques read: from the host's depth, or, where there is none or `ids` are needed, drawn from the casters.
shadow::GBuffer receive(gpu::PassList&, Casters&, HostImages&, const gnomon_frame&, const HostView&, bool ids);

} // namespace gnomon::host
