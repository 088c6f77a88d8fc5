// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "base/error.h"
#include "scene.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gnomon::python {

namespace {

/// Beyond this many metres squared lengths near the end of the range of float.
constexpr float farthest = 1e15f;

float number(const py::object& from, const char* name, const std::string& where, float least, float most)
{
    const py::object value = from.attr(name);
    const bool real = PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr());
    const float out = real ? value.cast<float>() : std::nanf("");
    if (!(out >= least && out <= most))
        base::fail("{} of {} is {}; it takes a number from {:g} to {:g}", name, where, py::str(value).cast<std::string>(), least, most);
    return out;
}

vec3 color(const py::object& from, const char* name, const std::string& where, float most)
{
    std::vector<float> values;
    try {
        values = from.attr(name).cast<std::vector<float>>();
    } catch (const py::cast_error&) { // said below
    }
    const auto fits = [most](float v) { return v >= 0.0f && v <= most; };
    if (values.size() != 3 || !std::all_of(values.begin(), values.end(), fits))
        base::fail("{} of {} takes three linear numbers from 0 to {:g}, red, green and blue", name, where, most);
    return {values[0], values[1], values[2]};
}

scene::Material material_of(const py::object& from, size_t index)
{
    constexpr float any = std::numeric_limits<float>::max();
    scene::Material out;
    const std::string where = fmt::format("material {}", index);
    out.name = py::str(from.attr("name")).cast<std::string>();
    out.base_color = vec4(color(from, "color", where, 1.0f), number(from, "alpha", where, 0, 1));
    out.metallic = number(from, "metallic", where, 0, 1), out.roughness = number(from, "roughness", where, 0, 1);
    out.emissive = color(from, "emissive", where, any);
    out.double_sided = py::bool_(from.attr("double_sided"));
    out.alpha = out.base_color.w < 1.0f ? scene::AlphaMode::blend : scene::AlphaMode::opaque;
    return out;
}

std::vector<vec3> vectors_of(const py::object& array, const std::string& name)
{
    const std::vector<float> values = rows_of_floats(array, 3, name);
    std::vector<vec3> out(values.size() / 3);
    for (size_t i = 0; i < out.size(); ++i) {
        out[i] = vec3(values[i * 3], values[i * 3 + 1], values[i * 3 + 2]);
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(out[i][c]) <= farthest))
                base::fail("row {} of {} holds {}; it takes numbers up to {:g}", i, name, out[i][c], farthest);
    }
    return out;
}

std::vector<vec3> normals_of(const py::object& array, size_t vertices, const std::string& name)
{
    if (array.is_none()) return {}; // scene::complete makes smooth ones
    std::vector<vec3> out = vectors_of(array, name);
    if (out.size() != vertices) base::fail("{} has {} rows for {} vertices", name, out.size(), vertices);
    for (size_t i = 0; i < out.size(); ++i) {
        const float length = glm::length(out[i]);
        if (!(length > 0.0f) || !std::isfinite(length))
            base::fail("row {} of {} has no direction; give a vector of any other length", i, name);
        out[i] /= length;
    }
    return out;
}

scene::Mesh mesh_of(const py::object& from, int material, const std::string& where)
{
    scene::Mesh out;
    out.name = py::str(from.attr("name")).cast<std::string>();
    out.positions = vectors_of(from.attr("vertices"), "vertices of " + where);
    out.normals = normals_of(from.attr("normals"), out.positions.size(), "normals of " + where);
    out.indices = rows_of_indices(from.attr("triangles"), 3, "triangles of " + where);
    out.material = material;
    if (out.indices.empty()) base::fail("{} has no triangle", where);
    const auto largest = std::max_element(out.indices.begin(), out.indices.end());
    if (*largest >= out.positions.size())
        base::fail("triangles of {} holds the index {} in row {}, but there are {} vertices", where, *largest,
            (largest - out.indices.begin()) / 3, out.positions.size());
    scene::complete(out);
    return out;
}

/// NumPy's matrices are rows, applied to columns (x, y, z, 1).
std::vector<mat4> transforms_of(const py::object& array, const std::string& name)
{
    if (array.is_none()) return {mat4(1)};
    const std::vector<double> values = matrices(array, name);
    std::vector<mat4> out(values.size() / 16);
    for (size_t i = 0; i < out.size(); ++i) {
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column) out[i][column][row] = float(values[i * 16 + size_t(row) * 4 + size_t(column)]);
        const mat4& m = out[i];
        bool sound = m[0][3] == 0.0f && m[1][3] == 0.0f && m[2][3] == 0.0f && m[3][3] == 1.0f;
        for (int k = 0; k < 12; ++k) sound = sound && std::abs(m[k / 3][k % 3]) <= farthest;
        if (!sound) base::fail("matrix {} of {} is no placement: its last row is 0, 0, 0, 1 and all else is finite", i, name);
        if (glm::determinant(glm::dmat3(glm::dmat4(m))) == 0.0)
            base::fail("matrix {} of {} flattens the mesh: its first three columns are to be independent", i, name);
    }
    return out;
}

} // namespace

std::shared_ptr<SharedScene> scene_of(const std::string& name, const py::list& materials, const py::list& meshes)
{
    lab::Stage stage;
    stage.scene_name = stage.scene.name = name;
    for (size_t i = 0; i < materials.size(); ++i) stage.scene.materials.push_back(material_of(materials[i], i));
    uint64_t placed = 0;
    for (size_t i = 0; i < meshes.size(); ++i) {
        const auto [mesh, material] = meshes[i].cast<std::pair<py::object, int>>();
        const std::string where = fmt::format("mesh {}", i);
        stage.scene.meshes.push_back(mesh_of(mesh, material, where));
        for (const mat4& m : transforms_of(mesh.attr("transforms"), "transforms of " + where)) {
            stage.scene.instances.push_back({int(i), m});
            placed += stage.scene.meshes.back().triangle_count();
        }
    }
    if (placed == 0) base::fail("a scene takes one mesh at least");
    if (placed >= 0xffffffffu) base::fail("the scene has {} triangles as placed; at most {} can be told apart", placed, 0xfffffffeu);
    stage.bounds = stage.scene.bounds();
    return std::make_shared<SharedScene>(std::move(stage));
}

} // namespace gnomon::python
