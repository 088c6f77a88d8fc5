// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "base/error.h"
#include "base/image_file.h"
#include "device.h"
#include "metrics/metrics.h"
#include "truth/cache.h"
#include "wait.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace gnomon::python {

namespace {

using Metrics = std::map<std::string, double>;

std::string key_of(const scene::Scene& scene, const Aim& aim, const Truth& truth)
{
    return truth::cache_key(scene, aim.view, aim.lights.front(), truth.settings, truth.quantity);
}

std::unique_ptr<Truth> trace(const std::shared_ptr<SharedScene>& scene, const lab::StageOptions& options, int samples,
    truth::Quantity quantity, const std::filesystem::path& cache)
{
    return wait_for([&](const std::stop_token& stop) {
        const SharedScene::Held held = scene->hold(options, stop);
        auto out = std::make_unique<Truth>(Truth{scene, held.aim(), {.samples = samples}, quantity, {}, {}, {}});
        out->aim.lights.resize(1);
        truth::Settings settings = out->settings;
        settings.stop = stop;
        out->reference = truth::reference(scene->scene(), out->aim.view, out->light(), settings, quantity, cache);
        out->key = key_of(scene->scene(), out->aim, *out);
        return out;
    });
}

/// A measurement and, where it was asked for, the signed map of the errors.
struct Judgement {
    Metrics metrics;
    base::Picture heat_map;
};

Judgement judge_render(const Render& render, Truth& truth, const Render* reference, bool heat_map, const std::stop_token& stop)
{
    demand_same(render, truth);
    Judgement out;
    lab::FilterReference filter;
    if (reference) {
        demand_same(*reference, truth);
        filter = {lab::choice_text(reference->choice), lab::judged_channels(reference->rendered.images.front(), 1), {}};
    }
    const SharedScene::Held held = truth.scene->hold(truth.aim, stop);
    lab::Run run = lab::new_run(held.stage(), render.choice, truth.light().name);
    lab::score(held.stage(), truth.light(), truth.reference, render.rendered, run,
        {.filter = reference ? &filter : nullptr, .heat_map = heat_map ? &out.heat_map : nullptr, .edge_band = &truth.edge_band});
    if (!run.reference_refused.empty()) base::fail("{}", run.reference_refused);
    out.metrics = std::move(run.metrics);
    return out;
}

void demand_like(const base::Picture& picture, const base::Picture& like, const char* name)
{
    if (picture.size == like.size && picture.channels == like.channels) return;
    base::fail("{} has {}x{} pixels and {} channels, the truth {}x{} and {}; both take the same", name, picture.size.width,
        picture.size.height, picture.channels, like.size.width, like.size.height, like.channels);
}

Judgement judge_array(const py::object& image, const Truth& truth, const py::object& mask, const py::object& reference, bool heat_map)
{
    const truth::Visibility& v = truth.reference.visibility;
    const base::Picture picture = picture_from(image, "image");
    demand_like(picture, v.mean, "image");
    std::vector<uint8_t> scored(picture.size.area());
    if (mask.is_none())
        for (size_t i = 0; i < scored.size(); ++i) scored[i] = truth.reference.primary.primitive[i] != truth::no_primitive;
    else
        scored = mask_from(mask, picture.size, "mask");
    base::Picture filter;
    if (!reference.is_none()) demand_like(filter = picture_from(reference, "reference"), v.mean, "reference");
    const base::Picture none;
    return wait_for([&](const std::stop_token&) {
        const metrics::Comparison comparison{picture, v.mean, v.variance, scored, !truth.light().soft()};
        Judgement out{metrics::measure(comparison), {}};
        if (!filter.empty()) out.metrics.merge(metrics::measure_filter({picture, filter, none, scored}));
        if (heat_map) out.heat_map = metrics::signed_heat_map(comparison);
        return out;
    });
}

py::tuple told(Judgement judgement)
{
    py::object map = py::none();
    if (!judgement.heat_map.empty()) map = array_of(base::encode8(judgement.heat_map, base::Encoding::linear), judgement.heat_map.size, 3);
    return py::make_tuple(judgement.metrics, map);
}

py::list metric_list(const std::vector<metrics::Metric>& metrics)
{
    using namespace py::literals;
    py::list out;
    for (const metrics::Metric& m : metrics)
        out.append(py::dict("id"_a = m.id, "unit"_a = m.unit, "help"_a = m.help, "hard"_a = m.hard, "soft"_a = m.soft));
    return out;
}

void bind_truth_class(py::module_& m)
{
    const auto view
        = [](auto member) { return [member](const py::object& self) { return view_of(member(self.cast<const Truth&>()), self); }; };
    py::class_<Truth>(
        m, "Truth", "Ray-traced truth of one light. Its arrays are read-only views that keep it alive; copy() what is to change.")
        .def_property_readonly("mean", view([](const Truth& t) -> auto& { return t.reference.visibility.mean; }),
            "The fraction of the light that reaches each pixel, H x W float32; H x W x 3 of transmittance and of a light with an image.")
        .def_property_readonly("variance", view([](const Truth& t) -> auto& { return t.reference.visibility.variance; }),
            "Of the mean, same shape; 0 of hard lights.")
        .def_property_readonly("depth", view([](const Truth& t) -> auto& { return t.reference.primary.depth; }),
            "Metres along the view axis, H x W float32; 0: background.")
        .def_property_readonly("position", view([](const Truth& t) -> auto& { return t.reference.primary.position; }),
            "What each pixel's centre shows, H x W x 3 float32, metres, world.")
        .def_property_readonly("normal", view([](const Truth& t) -> auto& { return t.reference.primary.normal; }),
            "The surface's unit normal there, H x W x 3 float32, world.")
        .def_property_readonly(
            "primitive",
            [](const py::object& self) {
                const auto& t = self.cast<const Truth&>();
                return view_of(t.reference.primary.primitive, t.aim.view.size, self);
            },
            "The triangle at each pixel's centre, counted through the whole scene, H x W uint32; 0xffffffff: none.")
        .def_property_readonly(
            "samples", [](const Truth& t) { return t.reference.visibility.samples; }, "Light samples a pixel.")
        .def_property_readonly(
            "hard", [](const Truth& t) { return !t.light().soft(); }, "Whether the light has no area.")
        .def_property_readonly("cached", [](const Truth& t) { return t.reference.from_cache; })
        .def_property_readonly(
            "trace_ms", [](const Truth& t) { return t.reference.trace_ms; }, "0 where it was cached.")
        .def_property_readonly("scene", [](const Truth& t) { return t.scene; })
        .def("__repr__", [](const Truth& t) {
            return fmt::format("<gnomon.Truth of {}, {}x{}, {} samples>", t.scene->name(), t.aim.view.size.width, t.aim.view.size.height,
                t.reference.visibility.samples);
        });
}

} // namespace

void demand_same(const Render& render, const Truth& truth)
{
    if (render.aim.lights.size() != 1 || key_of(render.scene->scene(), render.aim, truth) != truth.key)
        base::fail("the picture and the truth are of another scene, camera, light or size; give both the same");
    const int channels = lab::judged_channels(render.rendered.images.front(), truth.reference.visibility.mean.channels).channels;
    if (channels != truth.reference.visibility.mean.channels)
        base::fail("{} writes {} channels and the truth has {}; trace it with transmittance=True", lab::choice_text(render.choice),
            channels, truth.reference.visibility.mean.channels);
}

void bind_truth(py::module_& m)
{
    bind_truth_class(m);
    m.def("truth",
        [](const std::shared_ptr<SharedScene>& scene, const std::string& camera, const std::vector<std::string>& lights,
            std::pair<int, int> size, int samples, bool transmittance, const std::filesystem::path& cache) {
            return trace(scene, {{}, {}, camera, lights, {size.first, size.second}}, samples,
                transmittance ? truth::Quantity::transmittance : truth::Quantity::visibility, cache);
        });
    m.def("compare_render", [](const Render& render, Truth& truth, const Render* reference, bool heat_map) {
        return told(wait_for([&](const std::stop_token& stop) { return judge_render(render, truth, reference, heat_map, stop); }));
    });
    m.def("compare_array",
        [](const py::object& image, const Truth& truth, const py::object& mask, const py::object& reference, bool heat_map) {
            return told(judge_array(image, truth, mask, reference, heat_map));
        });
    m.def("metrics", [] { return metric_list(metrics::metrics()) + metric_list(metrics::filter_metrics()); });
    m.def("flip", [](const py::object& test, const py::object& truth, float pixels_per_degree) {
        const base::Picture a = picture_from(test, "test"), b = picture_from(truth, "truth");
        if (a.channels != 3) base::fail("test takes height x width x 3 of float32");
        demand_like(a, b, "test");
        base::Picture map;
        const double mean = wait_for([&](const std::stop_token&) { return metrics::flip(a, b, &map, pixels_per_degree); });
        return py::make_tuple(mean, array_of(std::move(map)));
    });
    m.def("read_exr", [](const std::filesystem::path& file) { return array_of(base::read_exr(file)); });
}

} // namespace gnomon::python
