// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_nodes.h"

#include "scene/gltf_accessor.h"

#include <algorithm>

namespace gnomon::scene::gltf {
namespace {

Node read_node(const Value& value)
{
    Node node;
    double m[16], t[3] = {0, 0, 0}, s[3] = {1, 1, 1}, r[4] = {0, 0, 0, 1};
    if (const Value matrix = value.find("matrix")) {
        matrix.numbers(m);
        node.has_matrix = true;
        for (int i = 0; i < 16; ++i) node.matrix[i / 4][i % 4] = m[i];
    }
    value.numbers_if("translation", t);
    value.numbers_if("rotation", r);
    value.numbers_if("scale", s);
    node.translation = dvec3(t[0], t[1], t[2]);
    node.rotation = dquat(r[3], r[0], r[1], r[2]);
    node.scale = dvec3(s[0], s[1], s[2]);
    const Value weights = value.find("weights");
    for (size_t i = 0; i < weights.size(); ++i) node.weights.push_back(float(weights[i].number()));
    return node;
}

/// Cuts every loop open at its first node: a node from which no way leads up to a root lies in one or below one.
void cut_loops(Document& document, std::vector<Node>& nodes)
{
    enum : uint8_t { unseen, on_the_way, settled };
    std::vector<uint8_t> state(nodes.size(), unseen);
    std::vector<size_t> way;
    for (size_t start = 0; start < nodes.size(); ++start) {
        way.clear();
        size_t at = start;
        while (state[at] == unseen) {
            state[at] = on_the_way;
            way.push_back(at);
            if (nodes[at].parent < 0) break;
            at = size_t(nodes[at].parent);
        }
        if (state[at] == on_the_way && nodes[at].parent >= 0) {
            document.warn(fmt::format("{}: nodes[{}] is a descendant of itself; it is cut off from its parent", document.file(), at));
            std::erase(nodes[size_t(nodes[at].parent)].children, at);
            nodes[at].parent = -1;
        }
        for (const size_t i : way) state[i] = settled;
    }
}

std::vector<size_t> scene_roots(Document& document, const std::vector<Node>& nodes, int scene)
{
    const size_t count = document.count("scenes");
    std::vector<size_t> roots;
    if (scene >= 0 && size_t(scene) >= count)
        base::fail("{}: there is no scene {}; the file has {}, counted from 0", document.file(), scene, count);
    if (count == 0) {
        for (size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i].parent < 0) roots.push_back(i);
        return roots;
    }
    const Value chosen = document.root().find("scene");
    Value value = document.element("scenes", size_t(std::max(scene, 0)));
    if (scene < 0 && chosen) document.recover("the first scene is used", [&] { value = document.element("scenes", chosen); });
    const Value list = value.find("nodes");
    for (size_t i = 0; i < list.size(); ++i)
        document.recover("it is left out", [&] {
            document.element("nodes", list[i]);
            roots.push_back(list[i].integer());
        });
    return roots;
}

} // namespace

std::vector<Node> read_nodes(Document& document)
{
    std::vector<Node> nodes;
    const size_t count = document.count("nodes");
    nodes.reserve(count);
    for (size_t i = 0; i < count; ++i) nodes.push_back(read_node(document.element("nodes", i)));
    for (size_t i = 0; i < count; ++i) {
        const Value children = document.element("nodes", i).find("children");
        for (size_t k = 0; k < children.size(); ++k)
            document.recover("the child is left out", [&] {
                document.element("nodes", children[k]);
                const size_t child = children[k].integer();
                if (nodes[child].parent >= 0) children[k].bad("names nodes[{}], which nodes[{}] has already", child, nodes[child].parent);
                nodes[child].parent = int(i);
                nodes[i].children.push_back(child);
            });
    }
    cut_loops(document, nodes);
    return nodes;
}

dmat4 composed(dvec3 translation, dquat rotation, dvec3 scale)
{
    const double length = glm::length(rotation);
    const glm::dmat3 r = length > 0 ? glm::mat3_cast(rotation / length) : glm::dmat3(1);
    return dmat4(glm::dvec4(r[0] * scale.x, 0), glm::dvec4(r[1] * scale.y, 0), glm::dvec4(r[2] * scale.z, 0), glm::dvec4(translation, 1));
}

void compose(std::vector<Node>& nodes)
{
    // An explicit stack: a hierarchy as deep as the file is long must not overflow that of the program.
    std::vector<size_t> open;
    for (size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].parent < 0) open.push_back(i);
    while (!open.empty()) {
        Node& node = nodes[open.back()];
        open.pop_back();
        const dmat4 own = node.has_matrix ? node.matrix : composed(node.translation, node.rotation, node.scale);
        node.world = node.parent < 0 ? own : nodes[size_t(node.parent)].world * own;
        open.insert(open.end(), node.children.begin(), node.children.end());
    }
}

std::vector<size_t> nodes_of_scene(Document& document, const std::vector<Node>& nodes, int scene)
{
    std::vector<size_t> open = scene_roots(document, nodes, scene), out;
    std::vector<bool> seen(nodes.size());
    std::ranges::reverse(open);
    while (!open.empty()) {
        const size_t i = open.back();
        open.pop_back();
        if (seen[i]) continue; // named as a root, and again as a child
        seen[i] = true;
        out.push_back(i);
        open.insert(open.end(), nodes[i].children.rbegin(), nodes[i].children.rend());
    }
    return out;
}

std::vector<mat4> joint_matrices(Document& document, const Value& skin, const std::vector<Node>& nodes)
{
    const Value joints = skin.at("joints");
    std::vector<float> inverse_bind;
    if (const Value reference = skin.find("inverseBindMatrices")) {
        const Accessor a = open_accessor(document, reference, {"MAT4"});
        if (a.component != Component::f32) a.value.bad("must hold floats");
        if (a.count < joints.size()) reference.bad("has {} matrices for {} joints", a.count, joints.size());
        inverse_bind.resize(a.count * 16);
        read_floats(document, a, inverse_bind.data());
    }
    std::vector<mat4> out;
    out.reserve(joints.size());
    for (size_t i = 0; i < joints.size(); ++i) {
        document.element("nodes", joints[i]);
        dmat4 bind(1);
        for (size_t k = 0; k < 16 && !inverse_bind.empty(); ++k) bind[int(k / 4)][int(k % 4)] = double(inverse_bind[i * 16 + k]);
        out.emplace_back(nodes[joints[i].integer()].world * bind);
    }
    if (out.empty()) skin.bad("has no joints");
    return out;
}

} // namespace gnomon::scene::gltf
