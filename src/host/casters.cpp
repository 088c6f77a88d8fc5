// SPDX-License-Identifier: Apache-2.0
#include "host/casters.h"

#include "host/result.h"
#include "src/host/gather.shared.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::host {

namespace {

Bounds bounds_of(const float (&lower)[3], const float (&upper)[3], uint32_t mesh)
{
    Bounds out;
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(lower[k]) || !std::isfinite(upper[k]) || lower[k] > upper[k])
            refuse(GNOMON_ERROR_ARGUMENT, "mesh {}: its bounds are no box, axis {} goes from {} to {}", mesh, "xyz"[k], lower[k], upper[k]);
    out.add(vec3(lower[0], lower[1], lower[2]));
    out.add(vec3(upper[0], upper[1], upper[2]));
    return out;
}

dmat4 finite_transform(const VkTransformMatrixKHR& m, uint32_t instance)
{
    for (const auto& row : m.matrix)
        for (const float number : row)
            if (!std::isfinite(number))
                refuse(GNOMON_ERROR_ARGUMENT, "instance {}: its transform has a number that is not finite", instance);
    return matrix_of(m);
}

bool is_mirrored(const dmat4& m) { return glm::determinant(glm::dmat3(m)) < 0.0; }

struct StreamFormat {
    VkFormat format;
    uint32_t kind, bytes; ///< GATHER_*; of what is read of an element
};
constexpr StreamFormat position_formats[]
    = {{VK_FORMAT_R32G32B32_SFLOAT, GATHER_FLOAT32, 12}, {VK_FORMAT_R32G32B32A32_SFLOAT, GATHER_FLOAT32, 12},
        {VK_FORMAT_R16G16B16A16_SFLOAT, GATHER_FLOAT16, 6}, {VK_FORMAT_R16G16B16_SFLOAT, GATHER_FLOAT16, 6},
        {VK_FORMAT_R16G16B16A16_SNORM, GATHER_SNORM16, 6}, {VK_FORMAT_R16G16B16A16_UNORM, GATHER_UNORM16, 6}};
constexpr StreamFormat uv_formats[] = {{VK_FORMAT_R32G32_SFLOAT, GATHER_FLOAT32, 8}, {VK_FORMAT_R16G16_SFLOAT, GATHER_FLOAT16, 4},
    {VK_FORMAT_R16G16_SNORM, GATHER_SNORM16, 4}, {VK_FORMAT_R16G16_UNORM, GATHER_UNORM16, 4}};
constexpr StreamFormat index_formats[] = {{VK_FORMAT_R32_UINT, 0, 4}, {VK_FORMAT_R16_UINT, 1, 2}};

const StreamFormat& format_of(VkFormat format)
{
    for (const std::span<const StreamFormat> known : {std::span<const StreamFormat>(position_formats),
             std::span<const StreamFormat>(uv_formats), std::span<const StreamFormat>(index_formats)})
        for (const StreamFormat& f : known)
            if (f.format == format) return f;
    throw std::logic_error("an unchecked format");
}

/// Throws where the format is none of these or the numbers do not fit.
void check_stream(const gnomon_stream& s, std::span<const StreamFormat> formats, const char* what, uint32_t mesh)
{
    const auto found = std::find_if(formats.begin(), formats.end(), [&](const StreamFormat& f) { return f.format == s.format; });
    if (found == formats.end())
        refuse(GNOMON_ERROR_UNSUPPORTED, "mesh {}: its {} are in the format {}, which is none of those that gnomon_stream::format lists",
            mesh, what, int(s.format));
    if (s.offset % 2 != 0 || s.stride % 2 != 0)
        refuse(GNOMON_ERROR_ARGUMENT, "mesh {}: offset {} and stride {} of its {} are not multiples of 2", mesh, s.offset, s.stride, what);
}

void check_mesh(const gnomon_mesh& m, uint32_t number, uint32_t materials)
{
    const uint32_t corners = m.indices.buffer ? m.index_count : m.vertex_count;
    if (!m.vertices.buffer || m.vertex_count == 0)
        refuse(GNOMON_ERROR_ARGUMENT, "mesh {} has no vertices; give its buffer and vertex_count", number);
    if (corners % 3 != 0) refuse(GNOMON_ERROR_ARGUMENT, "mesh {} has {} corners, which make no whole triangles", number, corners);
    if (m.material >= materials) refuse(GNOMON_ERROR_ARGUMENT, "mesh {} has material {}, and there are {}", number, m.material, materials);
    check_stream(m.vertices, position_formats, "vertices", number);
    if (m.texture_coordinates.buffer) check_stream(m.texture_coordinates, uv_formats, "texture coordinates", number);
    if (m.indices.buffer) check_stream(m.indices, index_formats, "indices", number);
}

scene::Material material_of(const gnomon_material& m, uint32_t number)
{
    if (m.kind > GNOMON_BLENDED)
        refuse(GNOMON_ERROR_ARGUMENT, "material {} is of kind {}; the kinds are 0 (opaque) to 2 (blended)", number, m.kind);
    scene::Material out;
    out.base_color = vec4(m.color[0], m.color[1], m.color[2], m.color[3]);
    out.alpha = scene::AlphaMode(m.kind);
    out.alpha_cutoff = m.cutoff;
    out.double_sided = m.double_sided != VK_FALSE;
    if (m.texture && m.kind != GNOMON_OPAQUE) out.base_color_texture.texture = int(number);
    return out;
}

} // namespace

Casters::Casters(std::shared_ptr<Device> device, const gnomon_scene_info& info)
    : device_(std::move(device))
    , given_(info.meshes, info.meshes + info.mesh_count)
    , materials_(info.materials, info.materials + info.material_count)
{
    if (info.mesh_count > 0 && info.material_count == 0)
        refuse(GNOMON_ERROR_ARGUMENT, "the scene has meshes and no material; give one at least");
    scene_.name = "the host's scene";
    for (uint32_t i = 0; i < info.material_count; ++i) scene_.materials.push_back(material_of(info.materials[i], i));
    if (scene_.materials.empty()) scene_.materials.emplace_back();
    for (uint32_t i = 0; i < info.mesh_count; ++i) check_mesh(given_[i], i, info.material_count);
    meshes_.assign(info.mesh_count, {-1, -1});

    Bounds all;
    for (uint32_t i = 0; i < info.instance_count; ++i) {
        const gnomon_instance& instance = info.instances[i];
        if (instance.mesh >= info.mesh_count)
            refuse(GNOMON_ERROR_ARGUMENT, "instance {} is of mesh {}, and there are {}", i, instance.mesh, info.mesh_count);
        const gnomon_mesh& mesh = given_[instance.mesh];
        all.add(transformed(bounds_of(mesh.lower, mesh.upper, instance.mesh), mat4(finite_transform(instance.transform, i))));
    }
    world_from_host_ = host::world_from_host(info.space, all.empty() ? dvec3(0.0) : dvec3(all.centre()));
    for (uint32_t i = 0; i < info.instance_count; ++i) add_instance(info.instances[i], i);

    std::vector<uvec2> counts;
    for (const Source& s : sources_)
        counts.emplace_back(s.mesh.vertex_count, s.mesh.indices.buffer ? s.mesh.index_count : s.mesh.vertex_count);
    resources_ = std::make_unique<shadow::SceneGpu>(*device_->gpu, scene_, counts, textures(info));
    for (uint32_t i = 0; i < sources_.size(); ++i) unread_.insert(i);
}

int Casters::mesh_for(uint32_t number, bool mirrored)
{
    // What is seen counter-clockwise must be so on Gnomon's screen too, which shows the host's world as it is and not its mirror image.
    const gnomon_mesh& given = given_[number];
    const bool turned = (given.clockwise != VK_FALSE) != mirrored;
    int& known = meshes_[number][turned];
    if (known >= 0) return known;
    scene::Mesh mesh;
    mesh.name = fmt::format("mesh {}", number);
    mesh.material = int(given.material);
    mesh.bounds = bounds_of(given.lower, given.upper, number);
    const uint32_t corners = given.indices.buffer ? given.index_count : given.vertex_count;
    if (given.positions) {
        for (uint32_t v = 0; v < given.vertex_count; ++v)
            mesh.positions.emplace_back(given.positions[3 * v], given.positions[3 * v + 1], given.positions[3 * v + 2]);
        for (uint32_t i = 0; i < corners; ++i) {
            const uint32_t from = turned && i % 3 != 0 ? i - i % 3 + 3 - i % 3 : i;
            const uint32_t index = given.triangles ? given.triangles[from] : from;
            mesh.indices.push_back(std::min(index, given.vertex_count - 1));
        }
    } else {
        mesh.absent_triangles = corners / 3;
        has_vertices_ = false;
    }
    known = int(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
    sources_.push_back({given, turned});
    return known;
}

void Casters::add_instance(const gnomon_instance& instance, uint32_t number)
{
    const dmat4 m = finite_transform(instance.transform, number);
    mirrored_.push_back(is_mirrored(m));
    scene_.instances.push_back({mesh_for(instance.mesh, mirrored_.back()), mat4(world_from_host_ * m)});
}

gpu::TextureTable Casters::textures(const gnomon_scene_info& info)
{
    // By the material's number; an opaque one's entry is never read.
    std::vector<VkDescriptorImageInfo> images;
    for (uint32_t i = 0; i < info.material_count; ++i)
        images.push_back({info.materials[i].sampler, info.materials[i].texture, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    return device_->gpu->texture_table(images);
}

void Casters::move(uint32_t first, std::span<const VkTransformMatrixKHR> transforms)
{
    if (first > scene_.instances.size() || transforms.size() > scene_.instances.size() - first)
        refuse(GNOMON_ERROR_ARGUMENT, "instances {} to {} were to be moved, and there are {}", first, first + transforms.size(),
            scene_.instances.size());
    std::vector<mat4> moved;
    for (uint32_t i = 0; i < transforms.size(); ++i) {
        const dmat4 m = finite_transform(transforms[i], first + i);
        if (is_mirrored(m) != mirrored_[first + i])
            refuse(GNOMON_ERROR_ARGUMENT,
                "instance {} would turn into its mirror image, which shows its triangles the other way round; make a new scene", first + i);
        moved.push_back(mat4(world_from_host_ * m));
    }
    for (uint32_t i = 0; i < moved.size(); ++i) scene_.instances[first + i].world_from_object = moved[i];
    if (!moved.empty()) resources_->moved();
}

void Casters::deform(uint32_t mesh, const float (&lower)[3], const float (&upper)[3])
{
    if (mesh >= meshes_.size()) refuse(GNOMON_ERROR_ARGUMENT, "mesh {} was to be deformed, and there are {}", mesh, meshes_.size());
    if (given_[mesh].positions)
        refuse(GNOMON_ERROR_ARGUMENT, "mesh {} has positions in host memory, which do not follow the device's; make it without them", mesh);
    const Bounds bounds = bounds_of(lower, upper, mesh);
    std::vector<uint32_t> changed;
    for (const int m : meshes_[mesh])
        if (m >= 0) changed.push_back(uint32_t(m)), scene_.meshes[size_t(m)].bounds = bounds;
    resources_->moved(changed);
    unread_.insert(changed.begin(), changed.end());
}

void Casters::add_stream(gpu::PassList& passes, const gnomon_stream& from, const Packed& to)
{
    gpu::Device& gpu = *device_->gpu;
    shaders::GatherConstants c{.count = to.count, .first = to.first, .turned = to.turned, .vertices = to.vertices};
    const gpu::BufferId target = passes.import(to.target);
    gpu::BufferId source = target; // where there is none, something has to be bound
    if (from.buffer) {
        const StreamFormat& format = format_of(from.format);
        c.stride = from.stride ? from.stride : format.bytes, c.format = format.kind, c.given = 1;
        const uint64_t alignment = gpu.limits().minStorageBufferOffsetAlignment, start = from.offset / alignment * alignment;
        const uint64_t bytes = (from.offset - start + uint64_t(to.count - 1) * c.stride + format.bytes + 3) / 4 * 4;
        if (bytes > gpu.limits().maxStorageBufferRange)
            refuse(GNOMON_ERROR_UNSUPPORTED, "a mesh's stream spans {} bytes and a storage buffer of this device {}; split the mesh", bytes,
                gpu.limits().maxStorageBufferRange);
        c.offset = uint32_t(from.offset - start);
        adopted_.push_back(gpu.adopt_buffer(from.buffer, {bytes, 0, gpu::Memory::device, "a stream of the host"}, start));
        source = passes.import(adopted_.back());
    }
    const gpu::Use read = from.buffer ? gpu::Use::load : gpu::Use::update, write = from.buffer ? gpu::Use::store : gpu::Use::update;
    passes.compute({.name = to.shader,
        .program = &gpu.compute_program(fmt::format("src/host/gather_{}.comp", to.shader)),
        .bindings = {{source, read}, {target, write}},
        .constants = c,
        .threads = {to.count}});
}

void Casters::add_reads(gpu::PassList& passes)
{
    adopted_.clear();
    adopted_.reserve(3 * unread_.size()); // lists keep references
    for (const uint32_t m : unread_) {
        const gnomon_mesh& mesh = sources_[m].mesh;
        const shadow::SceneGpu::MeshRange& range = resources_->range(m);
        add_stream(passes, mesh.vertices, {"positions", resources_->positions(), range.first_vertex, range.vertex_count});
        add_stream(passes, mesh.texture_coordinates, {"attributes", resources_->attributes(), range.first_vertex, range.vertex_count});
        gnomon_stream indices = mesh.indices;
        indices.stride = 0; // tightly packed
        if (range.index_count > 0)
            add_stream(passes, indices,
                {"indices", resources_->indices(), range.first_index, range.index_count, sources_[m].turned, range.vertex_count});
    }
}

} // namespace gnomon::host
