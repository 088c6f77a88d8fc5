// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

#include "base/error.h"
#include "base/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>

namespace gnomon::python {

namespace {

std::string shape_text(const py::array& a)
{
    std::vector<std::string> sides;
    for (py::ssize_t i = 0; i < a.ndim(); ++i) sides.push_back(std::to_string(a.shape(i)));
    return sides.empty() ? "a single number" : fmt::format("{}", fmt::join(sides, "x"));
}

/// An array of type T in memory order. `wanted` says, for people, what the argument takes.
template <class T> py::array_t<T> demand(const py::object& object, const std::string& name, const std::string& wanted)
{
    if (!py::isinstance<py::array>(object))
        base::fail("{} takes a NumPy array, {}, not a {}; numpy.asarray makes one", name, wanted,
            py::str(py::type::of(object).attr("__name__")).cast<std::string>());
    const auto array = py::reinterpret_borrow<py::array>(object);
    const std::string type = py::str(py::dtype::of<T>()).cast<std::string>();
    if (!py::isinstance<py::array_t<T>>(array))
        base::fail(
            "{} takes {}, not {}; convert it with .astype(numpy.{})", name, wanted, py::str(array.dtype()).cast<std::string>(), type);
    return py::array_t<T, py::array::c_style | py::array::forcecast>(array);
}

template <class T> std::vector<T> rows(const py::object& object, py::ssize_t columns, const std::string& name, const char* type)
{
    const std::string wanted = fmt::format("N x {} of {}", columns, type);
    const py::array_t<T> array = demand<T>(object, name, wanted);
    if (array.ndim() != 2 || array.shape(1) != columns) base::fail("{} takes {}, not {}", name, wanted, shape_text(array));
    return {array.data(), array.data() + array.size()};
}

void protect(py::array& array) { array.attr("setflags")(py::arg("write") = false); }

} // namespace

py::array view_of(const base::Picture& picture, py::handle owner, int shown)
{
    const py::ssize_t width = picture.size.width, height = picture.size.height, channels = picture.channels, number = sizeof(float);
    const py::ssize_t used = shown > 0 ? shown : channels;
    std::vector<py::ssize_t> shape{height, width}, strides{width * channels * number, channels * number};
    if (used > 1) shape.push_back(used), strides.push_back(number);
    py::array out(py::dtype::of<float>(), shape, strides, picture.values.data(), owner);
    protect(out);
    return out;
}

py::array view_of(const std::vector<uint32_t>& values, base::Size size, py::handle owner)
{
    py::array out(py::dtype::of<uint32_t>(), {size.height, size.width}, values.data(), owner);
    protect(out);
    return out;
}

py::array array_of(base::Picture picture)
{
    auto* kept = new base::Picture(std::move(picture));
    const py::capsule owner(kept, [](void* p) { delete static_cast<base::Picture*>(p); });
    std::vector<py::ssize_t> shape{kept->size.height, kept->size.width};
    if (kept->channels > 1) shape.push_back(kept->channels);
    return py::array(py::dtype::of<float>(), shape, kept->values.data(), owner);
}

py::array array_of(const std::vector<uint8_t>& values, base::Size size, int channels)
{
    return py::array(py::dtype::of<uint8_t>(), {size.height, size.width, channels}, values.data());
}

base::Picture picture_from(const py::object& object, const std::string& name)
{
    const char* wanted = "height x width, or height x width x 3, of float32";
    const py::array_t<float> array = demand<float>(object, name, wanted);
    const bool flat = array.ndim() == 2, deep = array.ndim() == 3 && (array.shape(2) == 1 || array.shape(2) == 3);
    if (!flat && !deep) base::fail("{} takes {}, not {}", name, wanted, shape_text(array));
    if (array.shape(0) < 1 || array.shape(1) < 1 || array.shape(0) > base::longest_side || array.shape(1) > base::longest_side)
        base::fail("{} is {} pixels large; a side has 1 to {}", name, shape_text(array), base::longest_side);
    base::Picture out({int(array.shape(1)), int(array.shape(0))}, flat ? 1 : int(array.shape(2)));
    std::memcpy(out.values.data(), array.data(), out.values.size() * sizeof(float));
    return out;
}

std::vector<uint8_t> mask_from(const py::object& object, base::Size size, const std::string& name)
{
    const std::string wanted = fmt::format("{} x {} (height x width) of bool", size.height, size.width);
    const py::array_t<bool> array = demand<bool>(object, name, wanted);
    if (array.ndim() != 2 || array.shape(0) != size.height || array.shape(1) != size.width)
        base::fail("{} takes {}, not {}", name, wanted, shape_text(array));
    return {array.data(), array.data() + array.size()};
}

std::vector<float> rows_of_floats(const py::object& object, py::ssize_t columns, const std::string& name)
{
    return rows<float>(object, columns, name, "float32");
}

std::vector<uint32_t> rows_of_indices(const py::object& object, py::ssize_t columns, const std::string& name)
{
    return rows<uint32_t>(object, columns, name, "uint32");
}

std::vector<double> matrices(const py::object& object, const std::string& name)
{
    const char* wanted = "4 x 4, or N x 4 x 4, of float64 or float32";
    const bool single = py::isinstance<py::array_t<float>>(object);
    const py::array_t<double> array
        = single ? py::array_t<double>(demand<float>(object, name, wanted)) : demand<double>(object, name, wanted);
    const py::ssize_t depth = array.ndim();
    if (depth < 2 || depth > 3 || array.shape(depth - 1) != 4 || array.shape(depth - 2) != 4 || array.size() == 0)
        base::fail("{} takes {}, not {}", name, wanted, shape_text(array));
    return {array.data(), array.data() + array.size()};
}

} // namespace gnomon::python
