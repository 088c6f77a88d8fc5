// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"

#include <cstdint>
#include <pybind11/numpy.h>
#include <string>
#include <vector>

// NumPy arrays and what Gnomon makes of them. Arrays that come in are never converted silently: another type or shape throws
// base::Error with the array's name and the call that converts it.
namespace gnomon::python {

namespace py = pybind11;

/// A read-only array over numbers that `owner` holds, which it keeps alive. HxW of one channel, else HxWxC, of which the first `shown`.
py::array view_of(const base::Picture&, py::handle owner, int shown = 0);
py::array view_of(const std::vector<uint32_t>&, base::Size, py::handle owner);
/// The same of an array of its own.
py::array array_of(base::Picture);
py::array array_of(const std::vector<uint8_t>& values, base::Size, int channels);

/// HxW or HxWxC, float32.
base::Picture picture_from(const py::object&, const std::string& name);
/// HxW of bool.
std::vector<uint8_t> mask_from(const py::object&, base::Size, const std::string& name);

/// The values of an array of `columns` numbers in each row, in order.
std::vector<float> rows_of_floats(const py::object&, py::ssize_t columns, const std::string& name);
std::vector<uint32_t> rows_of_indices(const py::object&, py::ssize_t columns, const std::string& name);
/// 4x4 or Kx4x4 of float32 or float64.
std::vector<double> matrices(const py::object&, const std::string& name);

} // namespace gnomon::python
