// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/casters.h"
#include "shadow/technique.h"

namespace gnomon::host {

/// A quality level in the words of gnomon_shadow_create.
gnomon_choice choose(const Device&, uint32_t level, const gnomon_light&);

/// One technique at work on a host's casters.
class Shadow {
public:
    Shadow(std::shared_ptr<Casters>, const char* technique, const char* settings);
    void set(const char* settings);
    uint64_t record(const gnomon_frame&); ///< the ticket

private:
    void check_inputs(const scene::Light&) const;
    void deliver(gpu::PassList&, gpu::ImageId from, gpu::ImageId to) const;
    void set_filter(const gnomon_frame&);

    std::shared_ptr<Casters> casters_;
    const shadow::TechniqueInfo& info_;
    shadow::ParamValues params_;
    std::unique_ptr<shadow::Technique> technique_;
    int kind_ = -1; ///< of the light, once one was recorded
};

} // namespace gnomon::host

struct gnomon_shadow_t {
    gnomon::host::Shadow shadow;
};
