// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/stage.h"

#include <memory>
#include <mutex>
#include <pybind11/pybind11.h>
#include <stop_token>

namespace gnomon::python {

/// Where one picture of a scene is seen from, under which lights.
struct Aim {
    scene::Camera camera;
    std::vector<scene::Light> lights;
    scene::View view;
};

/// A scene for many pictures, from any thread: one at a time aims it and holds it.
class SharedScene {
public:
    explicit SharedScene(lab::Stage stage)
        : stage_(std::move(stage))
    {
    }
    const scene::Scene& scene() const { return stage_.scene; } ///< never changes
    const std::string& name() const { return stage_.scene_name; }
    const Bounds& bounds() const { return stage_.bounds; }

    /// The scene aimed; no other thread gets it before this goes.
    class Held {
    public:
        const lab::Stage& stage() const { return *stage_; }
        Aim aim() const { return {stage_->camera, stage_->lights, stage_->view}; }

    private:
        friend SharedScene;
        std::unique_lock<std::timed_mutex> lock_;
        lab::Stage* stage_ = nullptr;
    };
    /// Waits for other threads' pictures. Throws base::Error where the options do not fit the scene, or it was stopped while it waited.
    Held hold(const lab::StageOptions&, const std::stop_token&);
    Held hold(const Aim&, const std::stop_token&);

private:
    Held wait(const std::stop_token&);
    std::timed_mutex mutex_;
    lab::Stage stage_;
};

std::shared_ptr<SharedScene> load_scene(const std::string& name_or_file, const scene::LoadOptions&);
/// From the dataclasses gnomon.Material and gnomon.Mesh; a mesh's material is an index among them.
std::shared_ptr<SharedScene> scene_of(const std::string& name, const pybind11::list& materials, const pybind11::list& meshes);

void bind_scene(pybind11::module_&);

} // namespace gnomon::python
