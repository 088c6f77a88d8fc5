// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/compare.h"
#include "scene.h"

#include <mutex>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::python {

/// A technique's picture with where it was seen from.
struct Render {
    std::shared_ptr<SharedScene> scene;
    Aim aim;
    lab::Choice choice;
    lab::Rendered rendered;
    std::vector<uint8_t> picture; ///< 8-bit sRGB; empty unless lit
    float ambient;
};

/// The truth of one light.
struct Truth {
    std::shared_ptr<SharedScene> scene;
    Aim aim; ///< with one light
    truth::Settings settings;
    truth::Quantity quantity;
    truth::Reference reference;
    std::string key; ///< a hash of all that it follows from
    std::vector<uint8_t> edge_band; ///< lab::ScoreOptions; whoever holds the scene may write it

    const scene::Light& light() const { return aim.lights.front(); }
};

struct RenderOptions {
    std::string technique; ///< lab::parse_choice
    std::string quality; ///< shadow::parse_level, in the place of `technique`; empty: that
    std::vector<std::pair<std::string, std::string>> params;
    lab::RenderSettings settings;
    float exposure = 0;
};

/// A Vulkan device and the scene that it drew last, which stays there until another is drawn. Used by one thread at a time: others wait.
class SharedDevice {
public:
    SharedDevice(const std::string& name, bool validation);
    const gpu::Device& gpu() const { return *device_; }

    Render render(const std::shared_ptr<SharedScene>&, lab::StageOptions, const RenderOptions&, const std::stop_token&);
    /// From the truth's camera, under its light.
    Render render(const Truth&, const RenderOptions&, const std::stop_token&);
    /// FLIP of the lit picture against that of the truth.
    double flip(const Render&, const Truth&, const std::stop_token&);

private:
    Render draw(const std::shared_ptr<SharedScene>&, const SharedScene::Held&, lab::Choice, const RenderOptions&);
    shadow::SceneGpu& on_device(const std::shared_ptr<SharedScene>&);
    void demand_valid() const;

    std::mutex mutex_;
    std::unique_ptr<gpu::Device> device_;
    std::shared_ptr<SharedScene> scene_;
    std::optional<shadow::SceneGpu> scene_gpu_;
};

void bind_device(pybind11::module_&);
void bind_truth(pybind11::module_&);

/// Throws base::Error where the picture was not made of what the truth is of.
void demand_same(const Render&, const Truth&);

} // namespace gnomon::python
