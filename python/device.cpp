// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "arrays.h"
#include "base/error.h"
#include "base/image_file.h"
#include "lab/quality.h"
#include "metrics/metrics.h"
#include "wait.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace gnomon::python {

SharedDevice::SharedDevice(const std::string& name, bool validation)
    : device_(gpu::Device::open({name, validation, {}}))
{
}

shadow::SceneGpu& SharedDevice::on_device(const std::shared_ptr<SharedScene>& scene)
{
    if (scene_ != scene || !scene_gpu_) {
        scene_gpu_.reset();
        scene_ = scene;
        scene_gpu_.emplace(*device_, scene->scene());
    }
    return *scene_gpu_;
}

void SharedDevice::demand_valid() const
{
    const auto& errors = device_->validation_errors();
    if (!errors.empty()) base::fail("the validation layers found {} errors, the first: {}", errors.size(), errors.front());
}

namespace {

lab::Choice choice_of(const RenderOptions& options)
{
    lab::Choice choice = lab::parse_choice(options.technique);
    for (const auto& [name, value] : options.params) choice.params.set(name, value);
    return choice;
}

} // namespace

Render SharedDevice::draw(
    const std::shared_ptr<SharedScene>& scene, const SharedScene::Held& held, lab::Choice choice, const RenderOptions& options)
{
    lab::Rendered rendered = lab::render(*device_, on_device(scene), held.stage(), choice, options.settings);
    demand_valid();
    std::vector<uint8_t> picture;
    if (options.settings.lit)
        picture = base::encode8(lab::display(rendered.radiance, held.stage(), options.exposure), base::Encoding::srgb);
    return {scene, held.aim(), std::move(choice), std::move(rendered), std::move(picture), options.settings.lighting.ambient};
}

Render SharedDevice::render(
    const std::shared_ptr<SharedScene>& scene, lab::StageOptions stage, const RenderOptions& options, const std::stop_token& stop)
{
    lab::Choice choice = choice_of(options);
    if (options.quality.empty()) stage.kinds = choice.info->lights;
    const std::lock_guard lock(mutex_);
    const SharedScene::Held held = scene->hold(stage, stop);
    if (!options.quality.empty()) choice = lab::quality_choice(options.quality, *device_, held.stage().lights);
    return draw(scene, held, std::move(choice), options);
}

Render SharedDevice::render(const Truth& truth, const RenderOptions& options, const std::stop_token& stop)
{
    lab::Choice choice = choice_of(options);
    if (const std::string reason = lab::unmeasurable(choice, *device_, truth.light()); !reason.empty()) base::fail("{}", reason);
    const std::lock_guard lock(mutex_);
    return draw(truth.scene, truth.scene->hold(truth.aim, stop), std::move(choice), options);
}

double SharedDevice::flip(const Render& render, const Truth& truth, const std::stop_token& stop)
{
    demand_same(render, truth);
    if (render.rendered.radiance.empty()) base::fail("flip compares lit pictures, and this one was rendered with lit=False");
    const std::lock_guard lock(mutex_);
    const SharedScene::Held held = truth.scene->hold(truth.aim, stop);
    const base::Picture lit
        = lab::shade_with(*device_, on_device(truth.scene), held.stage(), {truth.reference.visibility.mean}, {.ambient = render.ambient});
    demand_valid();
    return metrics::flip(lab::display(render.rendered.radiance, held.stage()), lab::display(lit, held.stage()));
}

namespace {

RenderOptions options_of(const std::string& technique, const std::vector<std::pair<std::string, std::string>>& params, const py::dict& with)
{
    RenderOptions out{technique, with["quality"].cast<std::string>(), params, {}, with["exposure"].cast<float>()};
    out.settings.samples = with["samples"].cast<int>(), out.settings.repeats = with["repeats"].cast<int>();
    out.settings.warm_up = with["warm_up"].cast<int>(), out.settings.frame_index = with["frame"].cast<uint32_t>();
    out.settings.lit = with["lit"].cast<bool>(), out.settings.count = true;
    out.settings.aovs = with["aovs"].cast<std::set<std::string>>();
    out.settings.aovs.insert(lab::scored_aovs.begin(), lab::scored_aovs.end());
    out.settings.lighting.ambient = with["ambient"].cast<float>();
    return out;
}

/// Of a technique's image, the channels that mean something.
py::array image_of(const py::object& self, size_t light)
{
    const auto& r = self.cast<const Render&>();
    const base::Picture& image = r.rendered.images.at(light);
    const shadow::Output output = lab::output_of(r.choice);
    const bool alpha = output != shadow::Output::visibility && output != shadow::Output::transmittance;
    return view_of(image, self, alpha ? image.channels : std::min(image.channels, 3));
}

py::tuple images_of(const py::object& self)
{
    const size_t count = self.cast<const Render&>().rendered.images.size();
    py::tuple out(count);
    for (size_t i = 0; i < count; ++i) out[i] = image_of(self, i);
    return out;
}

py::dict passes_of(const Render& r)
{
    py::dict out;
    for (const lab::PassStats& pass : r.rendered.passes) out[py::str(pass.name)] = pass.ms;
    return out;
}

void bind_render(py::module_& m)
{
    const auto lit = [](const py::object& self) -> py::object {
        const auto& picture = self.cast<const Render&>().rendered.radiance;
        return picture.empty() ? py::none() : py::object(view_of(picture, self));
    };
    const auto picture = [](const Render& r) -> py::object {
        return r.picture.empty() ? py::none() : py::object(array_of(r.picture, r.aim.view.size, 3));
    };
    const auto aovs = [](const py::object& self) {
        py::dict out;
        for (const auto& [name, image] : self.cast<const Render&>().rendered.aovs) out[py::str(name)] = view_of(image, self);
        return out;
    };
    py::class_<Render>(
        m, "Render", "A picture by one technique. Its arrays are read-only views that keep it alive; copy() what is to change.")
        .def_property_readonly(
            "visibility", [](const py::object& self) { return image_of(self, 0); },
            "The technique's image for the first light, float32: H x W, the fraction of the light that reaches each pixel; H x W x 3 in "
            "each colour, of transmittance and of a light with an image.")
        .def_property_readonly("images", &images_of, "The same for each light, a tuple.")
        .def_property_readonly("lit", lit, "The shaded picture, H x W x 3 float32, scene-referred linear; None of lit=False.")
        .def_property_readonly("picture", picture, "The same for a screen, H x W x 3 uint8, sRGB; None of lit=False.")
        .def_property_readonly(
            "primitive",
            [](const py::object& self) {
                const auto& r = self.cast<const Render&>();
                return view_of(r.rendered.primitive, r.aim.view.size, self);
            },
            "The triangle at each pixel's centre, counted through the whole scene, H x W uint32; 0xffffffff: none.")
        .def_property_readonly("aovs", aovs, "Further images by name, float32.")
        .def_property_readonly("passes", &passes_of, "Milliseconds of each pass on the device; the technique's own begin with its id.")
        .def_property_readonly(
            "technique_ms", [](const Render& r) { return r.rendered.technique_ms; }, "Of the technique's own passes.")
        .def_property_readonly(
            "technique_least_ms", [](const Render& r) { return r.rendered.technique_least_ms; }, "The least of the timed frames.")
        .def_property_readonly(
            "bytes", [](const Render& r) { return r.rendered.technique_bytes; }, "Device memory of the technique beyond its image.")
        .def_property_readonly(
            "counts", [](const Render& r) { return r.rendered.counts; }, "What the technique counted of its work.")
        .def_property_readonly(
            "technique", [](const Render& r) { return lab::choice_text(r.choice); },
            "The technique and the parameters that differ from their defaults.")
        .def_property_readonly("scene", [](const Render& r) { return r.scene; })
        .def("__repr__", [](const Render& r) {
            return fmt::format("<gnomon.Render of {} by {}, {}x{}>", r.scene->name(), lab::choice_text(r.choice), r.aim.view.size.width,
                r.aim.view.size.height);
        });
}

} // namespace

void bind_device(py::module_& m)
{
    using Params = std::vector<std::pair<std::string, std::string>>;
    bind_render(m);
    py::class_<SharedDevice, std::shared_ptr<SharedDevice>>(m, "Device",
        "A Vulkan device, as render() and compare() take it. It keeps the last scene that it drew. Threads that share one wait for one "
        "another; those with a device each do not.\n\n"
        "name: a part of the device's name (devices()); empty: the first GPU, else the software driver.\n"
        "validation: under the Vulkan validation layers, whose errors end a call.")
        .def(py::init<const std::string&, bool>(), py::arg("name") = "", py::arg("validation") = false)
        .def_property_readonly("name", [](const SharedDevice& d) { return d.gpu().info().name; })
        .def_property_readonly("driver", [](const SharedDevice& d) { return d.gpu().info().driver; })
        .def_property_readonly("allocated_bytes", [](const SharedDevice& d) { return d.gpu().allocated_bytes(); })
        .def("__repr__", [](const SharedDevice& d) { return fmt::format("<gnomon.Device {}>", d.gpu().info().name); })
        .def("_render",
            [](SharedDevice& d, const std::shared_ptr<SharedScene>& scene, const std::string& technique, const Params& params,
                const std::string& camera, const std::vector<std::string>& lights, std::pair<int, int> size, const py::dict& with) {
                RenderOptions options = options_of(technique, params, with);
                lab::StageOptions stage{{}, {}, camera, lights, {size.first, size.second}};
                return wait_for([&](const std::stop_token& stop) {
                    options.settings.stop = stop;
                    return d.render(scene, stage, options, stop);
                });
            })
        .def("_render_as",
            [](SharedDevice& d, const Truth& truth, const std::string& technique, const Params& params, const py::dict& with) {
                RenderOptions options = options_of(technique, params, with);
                return wait_for([&](const std::stop_token& stop) {
                    options.settings.stop = stop;
                    return d.render(truth, options, stop);
                });
            })
        .def("_flip", [](SharedDevice& d, const Render& render, const Truth& truth) {
            return wait_for([&](const std::stop_token& stop) { return d.flip(render, truth, stop); });
        });
}

} // namespace gnomon::python
