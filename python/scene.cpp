// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include "arrays.h"
#include "base/error.h"
#include "scene/load.h"
#include "wait.h"

#include <pybind11/stl.h>

namespace gnomon::python {

SharedScene::Held SharedScene::wait(const std::stop_token& stop)
{
    Held held;
    held.lock_ = std::unique_lock(mutex_, std::defer_lock);
    while (!held.lock_.try_lock_for(std::chrono::milliseconds(50)))
        if (stop.stop_requested()) base::fail("stopped while another thread used the scene {}", name());
    held.stage_ = &stage_;
    return held;
}

SharedScene::Held SharedScene::hold(const lab::StageOptions& options, const std::stop_token& stop)
{
    Held held = wait(stop);
    lab::aim_stage(stage_, options);
    return held;
}

SharedScene::Held SharedScene::hold(const Aim& aim, const std::stop_token& stop)
{
    Held held = wait(stop);
    stage_.camera = aim.camera, stage_.lights = aim.lights, stage_.view = aim.view;
    return held;
}

std::shared_ptr<SharedScene> load_scene(const std::string& name_or_file, const scene::LoadOptions& options)
{
    return wait_for([&](const std::stop_token&) {
        lab::StageOptions stage;
        stage.scene = name_or_file, stage.load = options;
        return std::make_shared<SharedScene>(lab::open_stage(stage));
    });
}

namespace {

py::tuple names_of(const auto& things)
{
    py::list out;
    for (const auto& thing : things) out.append(thing.name);
    return py::tuple(out);
}

py::tuple vector_of(vec3 v) { return py::make_tuple(v.x, v.y, v.z); }

} // namespace

void bind_scene(py::module_& m)
{
    py::class_<SharedScene, std::shared_ptr<SharedScene>>(m, "Scene",
        "Meshes, materials, lights and cameras; it never changes. Made by load() and scene().\n\n"
        "Units are metres, +Y is up, right-handed. Pictures of one scene are made one at a time, whichever threads ask for them.")
        .def_property_readonly("name", &SharedScene::name)
        .def_property_readonly(
            "triangle_count", [](const SharedScene& s) { return s.scene().triangle_count(); }, "Triangles, as placed.")
        .def_property_readonly(
            "cameras", [](const SharedScene& s) { return names_of(s.scene().cameras); }, "Names that the argument `camera` takes.")
        .def_property_readonly(
            "lights", [](const SharedScene& s) { return names_of(s.scene().lights); }, "Names that the argument `light` takes.")
        .def_property_readonly(
            "bounds", [](const SharedScene& s) { return py::make_tuple(vector_of(s.bounds().min), vector_of(s.bounds().max)); },
            "The least and the greatest corner, metres.")
        .def_property_readonly(
            "warnings", [](const SharedScene& s) { return s.scene().warnings; }, "What the loader repaired or left out, a sentence each.")
        .def("__repr__",
            [](const SharedScene& s) { return fmt::format("<gnomon.Scene {}, {} triangles>", s.name(), s.scene().triangle_count()); });
    m.def("load", [](const std::string& name, double time, double detail, int gltf_scene) {
        return load_scene(name, {time, detail, gltf_scene});
    });
    m.def("scene", &scene_of);
}

} // namespace gnomon::python
