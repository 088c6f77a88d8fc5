// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_mesh.h"

#include "scene/gltf_accessor.h"

#include <numeric>

namespace gnomon::scene::gltf {
namespace {

Accessor open_attribute(Document& document, const Value& reference, size_t vertices, std::initializer_list<std::string_view> types)
{
    Accessor a = open_accessor(document, reference, types);
    if (a.count != vertices) reference.bad("has {} elements for {} vertices", a.count, vertices);
    return a;
}

uint32_t packed(vec4 color)
{
    const uvec4 c(glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f);
    return c.x | c.y << 8 | c.z << 16 | c.w << 24;
}

std::vector<uint32_t> read_colors(Document& document, const Value& reference, size_t vertices)
{
    const Accessor a = open_attribute(document, reference, vertices, {"VEC3", "VEC4"});
    std::vector<float> values(a.count * size_t(a.width));
    read_floats(document, a, values.data());
    std::vector<uint32_t> out(a.count);
    for (size_t i = 0; i < out.size(); ++i) {
        vec4 color(1);
        for (int k = 0; k < a.width; ++k) {
            const float value = values[i * size_t(a.width) + size_t(k)];
            color[k] = value == value ? value : 1.0f; // a NaN would make the conversion to a whole number undefined
        }
        out[i] = packed(color);
    }
    return out;
}

void read_positions(Document& document, const Value& primitive, Mesh& mesh)
{
    const Value reference = primitive.at("attributes").find("POSITION");
    if (!reference) primitive.bad("has no POSITION");
    const Accessor a = open_accessor(document, reference, {"VEC3"});
    if (a.component == Component::u32) a.value.bad("must hold floats, or 8 or 16-bit integers (KHR_mesh_quantization)");
    if (!a.value.find("bufferView") && !a.value.find("sparse")) {
        const bool draco = bool(primitive.extension("KHR_draco_mesh_compression"));
        primitive.bad(
            "has positions without data{}", draco ? " (KHR_draco_mesh_compression is not supported; convert it with gltf-transform)" : "");
    }
    mesh.positions = read_vectors<vec3>(document, a);
}

void read_indices(Document& document, const Value& primitive, uint64_t mode, Mesh& mesh)
{
    const Value reference = primitive.find("indices");
    if (reference) {
        mesh.indices = read_integers(document, open_accessor(document, reference, {"SCALAR"}));
        const auto largest = std::ranges::max_element(mesh.indices);
        if (largest != mesh.indices.end() && *largest >= mesh.positions.size())
            reference.bad("holds the index {} at element {}, but the primitive has {} vertices", *largest, largest - mesh.indices.begin(),
                mesh.positions.size());
    } else {
        mesh.indices.resize(mesh.positions.size());
        std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    }
    constexpr uint64_t list = 4;
    if (mode == list && mesh.indices.size() % 3 != 0)
        document.warn(fmt::format("{}: {} has {} indices, not a multiple of 3; the last ones are left out", document.file(),
            primitive.path(), mesh.indices.size()));
    to_triangle_list(mode, mesh.indices);
}

/// Normals, texture coordinates and colours can be done without: a fault in one costs that one alone.
void read_optional_attributes(Document& document, const Value& primitive, int uv_set, Mesh& mesh)
{
    const Value attributes = primitive.at("attributes");
    const size_t vertices = mesh.positions.size();
    if (const Value reference = attributes.find("NORMAL"))
        document.recover("normals are made from the triangles",
            [&] { mesh.normals = read_vectors<vec3>(document, open_attribute(document, reference, vertices, {"VEC3"})); });
    if (const Value reference = attributes.find("COLOR_0"))
        document.recover("the vertex colours are left out", [&] { mesh.colors = read_colors(document, reference, vertices); });
    if (uv_set < 0) return;
    document.recover("its textures show their first texel alone", [&] {
        const std::string name = fmt::format("TEXCOORD_{}", uv_set);
        const Value reference = attributes.find(name);
        if (!reference) primitive.bad("has a material with textures, but no {}", name);
        mesh.uvs = read_vectors<vec2>(document, open_attribute(document, reference, vertices, {"VEC2"}));
    });
    for (vec2& uv : mesh.uvs)
        if (!(std::abs(uv.x) <= farthest && std::abs(uv.y) <= farthest)) uv = vec2(0);
}

} // namespace

Mesh read_primitive(Document& document, Materials& materials, const Value& primitive, const Deformation& deformation)
{
    const uint64_t mode = primitive.integer_or("mode", 4);
    if (mode > 6) primitive.bad("has the unknown mode {}", mode);
    if (mode < 4) primitive.bad("holds points or lines, which cast no shadow");
    Mesh mesh;
    read_positions(document, primitive, mesh);
    read_indices(document, primitive, mode, mesh);
    const Materials::Use use = materials.use(primitive);
    mesh.material = use.material;
    read_optional_attributes(document, primitive, use.uv_set, mesh);
    apply_morph(document, primitive, deformation.weights, mesh);
    if (!deformation.world_from_joint.empty()) apply_skin(document, primitive, deformation.world_from_joint, mesh);
    if (const size_t dropped = drop_bad_triangles(mesh))
        document.warn(fmt::format("{}: {} has {} triangles with positions that are not finite or beyond {:g} m; they are left out",
            document.file(), primitive.path(), dropped, farthest));
    if (mesh.indices.empty()) primitive.bad("has no triangle with three sound corners");
    drop_unused_vertices(mesh);
    finish_normals(mesh);
    complete(mesh);
    return mesh;
}

} // namespace gnomon::scene::gltf
