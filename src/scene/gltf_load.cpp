// SPDX-License-Identifier: Apache-2.0
#include "scene/load.h"

#include "scene/gltf_accessor.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_nodes.h"

#include <cmath>
#include <map>
#include <tuple>

namespace gnomon::scene {
namespace gltf {
namespace {

/// Builds the scene: meshes when a node first shows them, once for all nodes that show them alike.
class Loader {
public:
    Loader(Document& document, const LoadOptions& options)
        : document_(document)
        , options_(options)
        , materials_(document, scene_)
    {
    }
    Scene load();

private:
    using MeshKey = std::tuple<uint64_t, int64_t, std::vector<float>>; // index in the file, skin or -1, morph weights
    void place(size_t node);
    std::vector<dmat4> placements(const Value& node, const dmat4& world);
    std::vector<int> meshes_of(const Value& node, const Node& state, bool skinned);
    std::vector<int> read_mesh(const Value& mesh, const Deformation&);
    void add_instance(int mesh, const dmat4& world_from_object, size_t node);
    void mirror_instances();
    void aim_cameras();
    [[noreturn]] void fail_empty() const;

    Document& document_;
    const LoadOptions& options_;
    Scene scene_;
    Materials materials_;
    std::vector<Node> nodes_;
    std::map<MeshKey, std::vector<int>> shared_;
    static constexpr size_t most_triangles = size_t(1) << 27; ///< a thousand primitives may name one large buffer
    static constexpr size_t most_instances = size_t(1) << 24;
    size_t triangles_ = 0; ///< of all meshes, each counted once
    size_t placed_ = 0; ///< meshes by nodes, those left out too: each takes its time
    std::vector<bool> mirrored_; ///< an entry an instance: its matrix has a negative determinant
};

bool singular(const dmat4& m)
{
    const dvec3 x(m[0]), y(m[1]), z(m[2]);
    const double volume = std::abs(glm::dot(glm::cross(x, y), z)), box = glm::length(x) * glm::length(y) * glm::length(z);
    // Below 1e-30 the float determinant that shading needs is lost; below 1e-9 of the box the axes lie in a plane.
    return !(box > 1e-30 && volume > 1e-9 * box);
}

std::vector<dmat4> Loader::placements(const Value& node, const dmat4& world)
{
    const Value extension = node.extension("EXT_mesh_gpu_instancing");
    if (!extension) return {world};
    const Value attributes = extension.at("attributes");
    std::vector<dmat4> out;
    std::vector<vec3> translations, scales;
    std::vector<vec4> rotations;
    const auto read = [&]<class V>(const char* name, const char* type, std::vector<V>& values) {
        const Value reference = attributes.find(name);
        if (!reference) return;
        const Value stored = document_.element("accessors", reference);
        if (!stored.find("bufferView")) stored.bad("has no data"); // and would place its mesh a million times on one spot
        const Accessor accessor = open_accessor(document_, reference, {type});
        values = read_vectors<V>(document_, accessor);
    };
    read("TRANSLATION", "VEC3", translations);
    read("SCALE", "VEC3", scales);
    read("ROTATION", "VEC4", rotations);
    const size_t count = std::max({translations.size(), scales.size(), rotations.size()});
    for (const size_t n : {translations.size(), scales.size(), rotations.size()})
        if (n != 0 && n != count) attributes.bad("differ in their numbers of instances: {} and {}", n, count);
    for (size_t i = 0; i < count; ++i) {
        const dvec3 t = translations.empty() ? dvec3(0) : dvec3(translations[i]), s = scales.empty() ? dvec3(1) : dvec3(scales[i]);
        const vec4 r = rotations.empty() ? vec4(0, 0, 0, 1) : rotations[i];
        out.push_back(world * composed(t, dquat(double(r.w), double(r.x), double(r.y), double(r.z)), s));
    }
    return out;
}

std::vector<int> Loader::read_mesh(const Value& mesh, const Deformation& deformation)
{
    std::vector<int> out;
    const Value primitives = mesh.at("primitives");
    for (size_t i = 0; i < primitives.size(); ++i)
        document_.recover("the primitive is left out", [&] {
            Mesh read = read_primitive(document_, materials_, primitives[i], deformation);
            triangles_ += read.triangle_count();
            if (triangles_ > most_triangles)
                base::fail("{}: the file has more than {} triangles; simplify it with gltfpack", document_.file(), most_triangles);
            const std::string name = mesh.text_or("name", mesh.path());
            read.name = primitives.size() > 1 ? fmt::format("{}/{}", name, i) : name;
            out.push_back(int(scene_.meshes.size()));
            scene_.meshes.push_back(std::move(read));
        });
    return out;
}

std::vector<int> Loader::meshes_of(const Value& node, const Node& state, bool skinned)
{
    const Value reference = node.at("mesh"), mesh = document_.element("meshes", reference);
    Deformation deformation{state.weights, {}};
    if (deformation.weights.empty()) {
        const Value weights = mesh.find("weights");
        for (size_t i = 0; i < weights.size(); ++i) deformation.weights.push_back(float(weights[i].number()));
    }
    while (!deformation.weights.empty() && deformation.weights.back() == 0.0f) deformation.weights.pop_back();
    // A skin puts its mesh into the world whichever node shows it, so that this too is one mesh.
    const MeshKey key{reference.integer(), skinned ? int64_t(node.at("skin").integer()) : -1, deformation.weights};
    const auto [it, fresh] = shared_.try_emplace(key);
    if (!fresh) return it->second;
    if (skinned) deformation.world_from_joint = joint_matrices(document_, document_.element("skins", node.at("skin")), nodes_);
    return it->second = read_mesh(mesh, deformation);
}

void Loader::add_instance(int mesh, const dmat4& world_from_object, size_t node)
{
    if (placed_++ == most_instances)
        base::fail("{}: the file places more than {} meshes; merge them with gltfpack", document_.file(), most_instances);
    const mat4 m(world_from_object);
    const Bounds box = transformed(scene_.meshes[size_t(mesh)].bounds, m);
    const bool finite = glm::all(glm::lessThanEqual(glm::abs(box.min), vec3(farthest)))
        && glm::all(glm::lessThanEqual(glm::abs(box.max), vec3(farthest)));
    if (!finite || singular(world_from_object)) {
        document_.warn(fmt::format("{}: nodes[{}] has a transform that {}; its mesh is left out there", document_.file(), node,
            finite ? "flattens its mesh" : "is not finite"));
        return;
    }
    scene_.instances.push_back({mesh, m});
    mirrored_.push_back(glm::determinant(glm::dmat3(world_from_object)) < 0);
}

void Loader::place(size_t index)
{
    const Value node = document_.element("nodes", index);
    const Node& state = nodes_[index];
    add_light(document_, node, state.world, scene_);
    add_camera(document_, node, state.world, scene_);
    if (!node.find("mesh")) return;
    document_.recover("its mesh is left out", [&] {
        // The joints of a skin stand in the world themselves: the node's own transform does not count then.
        const bool skinned = bool(node.find("skin"));
        const std::vector<int> meshes = meshes_of(node, state, skinned);
        if (meshes.empty()) return; // a thousand nodes may name a million places for it
        const std::vector<dmat4> worlds = skinned ? std::vector<dmat4>{dmat4(1)} : placements(node, state.world);
        for (const dmat4& world : worlds)
            for (const int mesh : meshes) add_instance(mesh, world, index);
    });
}

/// The camera culls by the winding on the screen, which a matrix with a negative determinant turns round. Such an instance shows the
/// mesh's mirror image instead, M * diag(-1, 1, 1): one copy for all, or the mesh itself where nobody shows it as it is.
void Loader::mirror_instances()
{
    std::vector<int> plain(scene_.meshes.size()), image(scene_.meshes.size(), -1);
    for (size_t i = 0; i < mirrored_.size(); ++i) plain[size_t(scene_.instances[i].mesh)] += !mirrored_[i];
    for (size_t i = 0; i < mirrored_.size(); ++i) {
        if (!mirrored_[i]) continue;
        Instance& instance = scene_.instances[i];
        instance.world_from_object[0] = -instance.world_from_object[0];
        int& mine = image[size_t(instance.mesh)];
        if (mine < 0) {
            mine = instance.mesh;
            if (plain[size_t(instance.mesh)] > 0) {
                mine = int(scene_.meshes.size());
                scene_.meshes.push_back(Mesh(scene_.meshes[size_t(instance.mesh)]));
                scene_.meshes.back().name += " (mirrored)";
            }
            mirror_x(scene_.meshes[size_t(mine)]);
        }
        instance.mesh = mine;
    }
}

/// glTF cameras have no target. The nearest point of the view axis to the scene's centre is one that a viewer can turn about.
void Loader::aim_cameras()
{
    const vec3 centre = scene_.bounds().centre();
    for (Camera& camera : scene_.cameras) {
        const vec3 forward = glm::normalize(camera.target - camera.eye);
        const float distance = glm::dot(centre - camera.eye, forward);
        if (distance > 1.0f && distance < farthest) camera.target = camera.eye + forward * distance;
    }
}

void Loader::fail_empty() const
{
    const std::string& file = document_.file();
    std::string reason = fmt::format("no node of the scene shows one of its {} meshes", document_.count("meshes"));
    if (!scene_.warnings.empty()) reason = scene_.warnings.front();
    if (reason.starts_with(file)) reason.erase(0, file.size() + 2); // it is named already
    base::fail("{}: the file holds no triangles to draw ({}); choose another file or scene", file, reason);
}

Scene Loader::load()
{
    nodes_ = read_nodes(document_);
    animate(document_, nodes_, std::isfinite(options_.time) ? options_.time : 0.0);
    compose(nodes_);
    for (const size_t node : nodes_of_scene(document_, nodes_, options_.gltf_scene)) place(node);
    mirror_instances();
    scene_.warnings = document_.take_warnings();
    if (scene_.instances.empty()) fail_empty();
    if (scene_.triangle_count() > std::numeric_limits<uint32_t>::max())
        base::fail("{}: the file places {} triangles, at most 2^32 - 1 can be numbered; simplify it with gltfpack", document_.file(),
            scene_.triangle_count());
    aim_cameras();
    return std::move(scene_);
}

} // namespace
} // namespace gltf

Scene load_gltf(const std::filesystem::path& path, const LoadOptions& options)
{
    gltf::Document document(path);
    Scene scene = gltf::Loader(document, options).load();
    scene.name = path.stem().string();
    return scene;
}

} // namespace gnomon::scene
