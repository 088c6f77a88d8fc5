// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "device.h"
#include "lab/catalogue.h"
#include "lab/quality.h"
#include "scene.h"

#include <pybind11/pybind11.h>

namespace {

using namespace gnomon;
namespace py = pybind11;

/// Of one device, or of the one that would be opened: its errors are then the reasons why nothing is available.
std::string techniques(const python::SharedDevice* device)
{
    if (device) return lab::techniques_json(&device->gpu()).dump();
    try {
        return lab::techniques_json(gpu::Device::open({}).get()).dump();
    } catch (const base::Error& e) {
        return lab::techniques_json(nullptr, e.what()).dump();
    }
}

} // namespace

PYBIND11_MODULE(_gnomon, m)
{
    m.doc() = "What gnomon/__init__.py is built on.";
    py::register_exception<base::Error>(m, "Error", PyExc_RuntimeError).attr("__doc__")
        = "What cannot be done, in a sentence that names the thing, the place and the next step.";
    m.attr("__version__") = GNOMON_VERSION_TEXT;
    m.def("techniques", &techniques);
    m.def("scenes", [] { return lab::scenes_json().dump(); });
    m.def("qualities", [] { return lab::qualities_json().dump(); });
    m.def("devices", [] { return lab::devices_json().dump(); });
    python::bind_scene(m);
    python::bind_device(m); // Render, which Truth's functions take
    python::bind_truth(m);
}
