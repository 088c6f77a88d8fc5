// SPDX-License-Identifier: Apache-2.0
// Morph targets and skins, applied on the CPU: a scene is a snapshot at one time.
#include "scene/gltf_accessor.h"
#include "scene/gltf_mesh.h"

namespace gnomon::scene::gltf {
namespace {

void add_target(Document& document, const Value& reference, float weight, std::vector<vec3>& values)
{
    if (!reference || values.empty()) return;
    const Accessor a = open_accessor(document, reference, {"VEC3"});
    if (a.count != values.size()) reference.bad("has {} elements for {} vertices", a.count, values.size());
    const std::vector<vec3> deltas = read_vectors<vec3>(document, a);
    for (size_t i = 0; i < values.size(); ++i) values[i] += weight * deltas[i];
}

/// Joint indices and weights of all sets, `width` of each a vertex; the weights of a vertex add up to 1 (or are all 0).
struct Influences {
    size_t width = 0;
    std::vector<uint32_t> joints;
    std::vector<float> weights;
};

void add_set(Document& document, const Value& attributes, int set, size_t vertices, size_t joint_count, Influences& out)
{
    const Value joint_reference = attributes.at(fmt::format("JOINTS_{}", set)),
                weight_reference = attributes.at(fmt::format("WEIGHTS_{}", set));
    const Accessor joint_accessor = open_accessor(document, joint_reference, {"VEC4"});
    const Accessor weight_accessor = open_accessor(document, weight_reference, {"VEC4"});
    if (joint_accessor.count != vertices || weight_accessor.count != vertices)
        joint_reference.bad(
            "and the weights have {} and {} elements for {} vertices", joint_accessor.count, weight_accessor.count, vertices);
    const std::vector<uint32_t> joints = read_integers(document, joint_accessor);
    const std::vector<vec4> weights = read_vectors<vec4>(document, weight_accessor);
    for (size_t v = 0; v < vertices; ++v) {
        for (size_t k = 0; k < 4; ++k) {
            const float weight = weights[v][int(k)];
            const size_t at = v * out.width + size_t(set) * 4 + k;
            // Padding often names any joint with weight 0, so only a joint in use must exist.
            if (weight == 0.0f) continue;
            if (joints[v * 4 + k] >= joint_count)
                joint_reference.bad("names joint {} at vertex {}, but the skin has {}", joints[v * 4 + k], v, joint_count);
            out.joints[at] = joints[v * 4 + k];
            out.weights[at] = weight;
        }
    }
}

Influences read_influences(Document& document, const Value& primitive, size_t vertices, size_t joint_count)
{
    const Value attributes = primitive.at("attributes");
    if (!attributes.find("JOINTS_0") || !attributes.find("WEIGHTS_0"))
        primitive.bad("belongs to a skin, but has no JOINTS_0 and WEIGHTS_0");
    const int sets = attributes.find("JOINTS_1") && attributes.find("WEIGHTS_1") ? 2 : 1;
    Influences out;
    out.width = size_t(sets) * 4;
    out.joints.resize(vertices * out.width);
    out.weights.resize(vertices * out.width);
    for (int set = 0; set < sets; ++set) add_set(document, attributes, set, vertices, joint_count, out);
    for (size_t v = 0; v < vertices; ++v) {
        float sum = 0.0f;
        for (size_t k = 0; k < out.width; ++k) sum += out.weights[v * out.width + k];
        if (sum != 0.0f)
            for (size_t k = 0; k < out.width; ++k) out.weights[v * out.width + k] /= sum;
    }
    return out;
}

mat3 cofactor(const mat3& m) { return mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])); }

} // namespace

void apply_morph(Document& document, const Value& primitive, std::span<const float> weights, Mesh& mesh)
{
    const Value targets = primitive.find("targets");
    const size_t count = std::min(targets.size(), weights.size());
    for (size_t i = 0; i < count; ++i) {
        if (weights[i] == 0.0f) continue;
        add_target(document, targets[i].find("POSITION"), weights[i], mesh.positions);
        add_target(document, targets[i].find("NORMAL"), weights[i], mesh.normals);
    }
}

void apply_skin(Document& document, const Value& primitive, std::span<const mat4> world_from_joint, Mesh& mesh)
{
    const Influences influences = read_influences(document, primitive, mesh.positions.size(), world_from_joint.size());
    size_t mirrored = 0;
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        mat4 m(0.0f);
        for (size_t k = 0; k < influences.width; ++k) {
            const size_t at = v * influences.width + k;
            if (influences.weights[at] != 0.0f) m += influences.weights[at] * world_from_joint[influences.joints[at]];
        }
        // A vertex that no joint holds is nowhere; m.w is then 0, and the quotient NaN has its triangles left out.
        mesh.positions[v] = vec3(m * vec4(mesh.positions[v], 1.0f)) / m[3][3];
        const mat3 linear(m);
        const float determinant = glm::determinant(linear);
        mirrored += determinant < 0.0f;
        // cofactor(m) = det(m) * inverse transpose: no division by a determinant that may vanish, but its sign must go.
        if (!mesh.normals.empty()) mesh.normals[v] = cofactor(linear) * mesh.normals[v] * (determinant < 0.0f ? -1.0f : 1.0f);
    }
    if (mirrored * 2 > mesh.positions.size())
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

} // namespace gnomon::scene::gltf
