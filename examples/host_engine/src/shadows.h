// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene.h"

#include <gnomon/gnomon.hpp>

#include <string>
#include <vector>

namespace host {

/// The whole of Gnomon in this renderer: nothing outside of shadows.cpp, and of gnomon_require where the device is made, calls it.
class Shadows {
public:
    /// A shadow of the scene's light for each technique; all share one copy of the casters.
    Shadows(const Gpu&, const Scene&, const Convention&, const std::vector<std::string>& techniques, const std::string& settings);

    struct Request {
        VkCommandBuffer commands; ///< recording; depth and normals have been drawn
        uint32_t frame;
        const std::vector<InstanceData>& posed;
        const Light& light;
        const View& view;
        const Image &depth, *normals; ///< in their attachment layouts; normals may be null
        const Image& visibility; ///< written, and left to be read by shaders
    };
    uint64_t record(size_t technique, const Request&); ///< the ticket for `finished`
    void finished(uint64_t ticket) { device_.retire(ticket); } ///< the commands up to there are done
    uint64_t bytes() const { return device_.bytes(); }

    /// A function for each of Gnomon's objects that destroys it; they may be called in any order.
    void destroyers(std::vector<std::function<void()>>& out);

private:
    void create_scene();
    const Scene& scene_;
    Convention convention_;
    gnomon::Device device_;
    gnomon::Scene casters_;
    std::vector<gnomon::Shadow> shadows_;
};

} // namespace host
