// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device_fixture.h"
#include "techniques/virtual_shadow_map/virtual_shadow_map.h"

#include "scene/load.h"
#include "shadow/gbuffer.h"

#include <cmath>
#include <utility>
#include <vector>

namespace gnomon::gpu {

using Values = std::vector<std::pair<const char*, double>>;
namespace vsm = techniques::virtual_shadow_map;

/// What one frame of the technique left.
struct VirtualFrame {
    std::vector<float> image;
    std::vector<float> depth; ///< of the G-buffer; 0 = background
    vsm::Counts counts;
    double ms = 0; ///< of the technique's passes
};

/// One object of the technique, drawn frame after frame.
class VirtualSession {
public:
    VirtualSession(Device& device, const shadow::TechniqueInfo& info, const Values& values)
        : device_(device)
        , params_(info.params())
        , technique_(device)
    {
        for (const auto& [name, value] : values) params_.set(name, value);
    }

    VirtualFrame draw(shadow::SceneGpu& scene, const scene::Camera& camera, const scene::Light& light, Size size)
    {
        const scene::View view = scene::make_view(camera, size, scene.bounds());
        Image out = image("visibility", VK_FORMAT_R32_SFLOAT, size);
        Image depth = image("depth copy", VK_FORMAT_D32_SFLOAT, size), normal = image("normal copy", VK_FORMAT_R32G32_UINT, size);
        PassList passes(device_);
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        passes.group("technique");
        technique_.record(passes, {scene.scene(), view, light, scene, g, passes.import(out), 0}, params_.bytes());
        passes.group("");
        passes.copy(g.depth, passes.import(depth));
        passes.copy(g.normal, passes.import(normal));
        const Submitted submitted = device_.submit(std::move(passes));
        VirtualFrame frame{device_.read_back(out).values, device_.read_back(depth).values, technique_.counts()};
        for (const PassTime& t : submitted.times)
            if (t.name.starts_with("technique/")) frame.ms += t.ms;
        const std::vector<std::byte> words = device_.read_back_bytes(normal);
        normals_.resize(words.size() / 4);
        std::memcpy(normals_.data(), words.data(), words.size());
        return frame;
    }

    vsm::VirtualShadowMap& technique() { return technique_; }
    const std::vector<uint32_t>& normals() const { return normals_; } ///< of the last frame: shading and geometric, encoded

private:
    Image image(const char* name, VkFormat format, Size size)
    {
        return device_.image({format, size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
    }

    Device& device_;
    shadow::ParamValues params_;
    vsm::VirtualShadowMap technique_;
    std::vector<uint32_t> normals_;
};

} // namespace gnomon::gpu
