// SPDX-License-Identifier: Apache-2.0
#include "shadow/scene_gpu_impl.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace gnomon::shadow {

namespace {

int16_t snorm16(float v) { return int16_t(std::lround(std::clamp(v, -1.0f, 1.0f) * 32767.0f)); }

/// The twin of encode_normal in shaders/octahedral.glsl.
uint32_t encode_normal(vec3 n)
{
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    n = sum > 0.0f ? n / sum : vec3(0, 0, 1);
    if (n.z < 0.0f) {
        const vec2 folded((1.0f - std::abs(n.y)) * (n.x >= 0.0f ? 1.0f : -1.0f), (1.0f - std::abs(n.x)) * (n.y >= 0.0f ? 1.0f : -1.0f));
        n.x = folded.x, n.y = folded.y;
    }
    return uint32_t(uint16_t(snorm16(n.x))) | uint32_t(uint16_t(snorm16(n.y))) << 16;
}

gpu_layout::TextureUse pack(const scene::TextureUse& use) { return {use.texture, use.u_row, use.v_row}; }

gpu_layout::Material pack(const scene::Material& m)
{
    gpu_layout::Material out{};
    out.base_color = m.base_color, out.emissive = m.emissive, out.metallic = m.metallic, out.roughness = m.roughness;
    out.alpha_cutoff = m.alpha_cutoff, out.transmission = m.transmission;
    out.flags = (m.double_sided ? 1u : 0u) | (m.alpha == scene::AlphaMode::mask ? 2u : 0u) | (m.alpha == scene::AlphaMode::blend ? 4u : 0u);
    const float crossings
        = std::isfinite(m.attenuation_distance) && m.attenuation_distance > 0.0f ? m.thickness / m.attenuation_distance : 0.0f;
    out.volume_tint = glm::pow(m.attenuation_color, vec3(crossings));
    out.base_color_texture = pack(m.base_color_texture);
    out.metallic_roughness_texture = pack(m.metallic_roughness_texture);
    out.emissive_texture = pack(m.emissive_texture);
    return out;
}

gpu_layout::Instance pack(const mat4& m)
{
    gpu_layout::Instance out{};
    for (int row = 0; row < 3; ++row) out.rows[row] = vec4(m[0][row], m[1][row], m[2][row], m[3][row]);
    return out;
}

template <class T> gpu::Buffer make_buffer(gpu::Device& device, const std::vector<T>& values, VkBufferUsageFlags usage, const char* name)
{
    // never empty: an empty storage buffer cannot be bound
    gpu::Buffer buffer = device.buffer({std::max<uint64_t>(values.size() * sizeof(T), 16), usage, gpu::Memory::device, name});
    if (!values.empty()) device.upload(buffer, std::as_bytes(std::span(values)));
    return buffer;
}

gpu::Sampler sampler_of(const scene::Texture& t)
{
    const bool mirror = t.wrap_u == scene::Wrap::mirror, clamp = t.wrap_u == scene::Wrap::clamp;
    if (t.linear) return mirror ? gpu::Sampler::linear_mirror : clamp ? gpu::Sampler::linear_clamp : gpu::Sampler::linear_repeat;
    return mirror ? gpu::Sampler::nearest_mirror : clamp ? gpu::Sampler::nearest_clamp : gpu::Sampler::nearest_repeat;
}

void upload_textures(SceneGpu::Impl& s)
{
    std::vector<const gpu::Image*> images;
    std::vector<gpu::Sampler> samplers;
    for (const scene::Texture& t : s.scene->textures) {
        const uint32_t mips = 1 + uint32_t(std::floor(std::log2(std::max(std::max(t.width, t.height), 1))));
        const VkFormat format = t.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
        s.images.push_back(s.device->image({format, {t.width, t.height}, 1, mips, VK_SAMPLE_COUNT_1_BIT, false, t.name}));
        s.device->upload(s.images.back(), std::as_bytes(std::span(t.rgba)));
        if (mips > 1) s.device->generate_mips(s.images.back());
        samplers.push_back(sampler_of(t));
    }
    for (const gpu::Image& image : s.images) images.push_back(&image);
    s.textures = s.device->texture_table(images, samplers);
}

void make_geometry(SceneGpu::Impl& s, std::span<const uvec2> counts)
{
    uint64_t vertices = 0, indices = 0;
    for (const uvec2 count : counts) {
        s.ranges.push_back({uint32_t(vertices), count.x, uint32_t(indices), count.y});
        vertices += count.x, indices += count.y;
    }
    if (vertices > 0x7fffffffu || indices > 0xffffffffu)
        base::fail("the scene '{}' has {} vertices and {} indices, above the 31 and 32 bits of a draw; split it", s.scene->name, vertices,
            indices);
    const VkBufferUsageFlags vertex = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                             trace = s.device->info().ray_query || s.device->info().ray_tracing_pipeline
        ? VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR
        : 0;
    s.positions = s.device->buffer({std::max<uint64_t>(vertices, 1) * 12, vertex | trace, gpu::Memory::device, "positions"});
    s.attributes
        = s.device->buffer({std::max<uint64_t>(vertices, 1) * sizeof(gpu_layout::Attributes), vertex, gpu::Memory::device, "attributes"});
    s.indices
        = s.device->buffer({std::max<uint64_t>(indices, 1) * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT | trace, gpu::Memory::device, "indices"});
}

void upload_geometry(SceneGpu::Impl& s, const scene::Scene* previous)
{
    std::vector<uvec2> counts;
    for (const scene::Mesh& m : s.scene->meshes) counts.emplace_back(uint32_t(m.positions.size()), uint32_t(m.indices.size()));
    make_geometry(s, counts);
    if (previous)
        s.previous
            = s.device->buffer({s.positions.desc().bytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::Memory::device, "previous positions"});
    // One mesh at a time through `upload`, so that a scene of a million triangles is never held twice in host memory.
    std::vector<gpu_layout::Attributes> attributes;
    for (size_t m = 0; m < s.scene->meshes.size(); ++m) {
        const scene::Mesh& mesh = s.scene->meshes[m];
        const MeshRange& range = s.ranges[m];
        attributes.resize(mesh.positions.size());
        for (size_t v = 0; v < mesh.positions.size(); ++v)
            attributes[v] = {encode_normal(mesh.normals[v]), mesh.uvs.empty() ? vec2(0) : mesh.uvs[v],
                mesh.colors.empty() ? 0xffffffffu : mesh.colors[v]};
        if (!mesh.positions.empty()) {
            s.device->upload(s.positions, std::as_bytes(std::span(mesh.positions)), uint64_t(range.first_vertex) * 12);
            s.device->upload(
                s.attributes, std::as_bytes(std::span(attributes)), uint64_t(range.first_vertex) * sizeof(gpu_layout::Attributes));
        }
        if (!mesh.indices.empty()) s.device->upload(s.indices, std::as_bytes(std::span(mesh.indices)), uint64_t(range.first_index) * 4);
        if (previous && !mesh.positions.empty())
            s.device->upload(s.previous, std::as_bytes(std::span(previous->meshes[m].positions)), uint64_t(range.first_vertex) * 12);
    }
}

/// Sorted by state and mesh: equal meshes become one instanced draw.
void make_slots(SceneGpu::Impl& s)
{
    std::vector<uint32_t> order(s.scene->instances.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto material_of = [&](const scene::Mesh& mesh) -> const scene::Material& { return s.scene->materials[size_t(mesh.material)]; };
    const auto rank = [&](uint32_t i) {
        const int mesh = s.scene->instances[i].mesh;
        const scene::Material& m = material_of(s.scene->meshes[size_t(mesh)]);
        return std::pair(int(m.alpha) * 2 + int(m.double_sided), mesh);
    };
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
    for (const uint32_t i : order) {
        const scene::Mesh& mesh = s.scene->meshes[size_t(s.scene->instances[i].mesh)];
        const scene::Material& material = material_of(mesh);
        const DrawSet set = material.alpha == scene::AlphaMode::opaque ? draw_opaque
            : material.alpha == scene::AlphaMode::mask                 ? draw_masked
                                                                       : draw_blended;
        s.slots.push_back({i, uint32_t(s.scene->instances[i].mesh), set, material.double_sided, {}});
        if (mesh.triangle_count() > 0) s.sets |= set;
    }
}

void find_bounds(SceneGpu::Impl& s)
{
    s.bounds = s.scene->bounds();
    for (Slot& slot : s.slots)
        slot.bounds = transformed(s.scene->meshes[slot.mesh].bounds, s.scene->instances[slot.instance].world_from_object);
}

std::vector<gpu_layout::Instance> packed_instances(const SceneGpu::Impl& s)
{
    const std::vector<uint32_t> first_primitive = s.scene->first_primitives();
    std::vector<gpu_layout::Instance> instances;
    for (const Slot& slot : s.slots) {
        gpu_layout::Instance packed = pack(s.scene->instances[slot.instance].world_from_object);
        const MeshRange& range = s.ranges[slot.mesh];
        packed.first_primitive = first_primitive[slot.instance], packed.material = uint32_t(s.scene->meshes[slot.mesh].material);
        packed.first_index = range.first_index, packed.first_vertex = range.first_vertex;
        instances.push_back(packed);
    }
    return instances;
}

void upload_instances(SceneGpu::Impl& s, const scene::Scene* previous)
{
    make_slots(s);
    find_bounds(s);
    s.instances = make_buffer(*s.device, packed_instances(s), 0, "instances");
    if (!previous) return;
    std::vector<gpu_layout::Instance> before;
    for (const Slot& slot : s.slots) before.push_back(pack(previous->instances[slot.instance].world_from_object));
    s.previous_instances = make_buffer(*s.device, before, 0, "previous instances");
}

void upload_materials(SceneGpu::Impl& s)
{
    std::vector<gpu_layout::Material> materials;
    for (const scene::Material& m : s.scene->materials) {
        materials.push_back(pack(m));
        s.emits = s.emits || m.emissive != vec3(0);
    }
    s.materials = make_buffer(*s.device, materials, 0, "materials");
}

} // namespace

SceneGpu::SceneGpu(gpu::Device& device, const scene::Scene& scene, const scene::Scene* previous)
    : impl_(std::make_unique<Impl>())
{
    Impl& s = *impl_;
    s.device = &device, s.scene = &scene;
    upload_geometry(s, previous);
    upload_instances(s, previous);
    upload_materials(s);
    upload_textures(s);
}

SceneGpu::SceneGpu(gpu::Device& device, const scene::Scene& scene, std::span<const uvec2> counts, gpu::TextureTable textures)
    : impl_(std::make_unique<Impl>())
{
    Impl& s = *impl_;
    s.device = &device, s.scene = &scene;
    make_geometry(s, counts);
    upload_instances(s, nullptr);
    upload_materials(s);
    s.textures = std::move(textures);
}

void SceneGpu::moved(std::span<const uint32_t> deformed)
{
    Impl& s = *impl_;
    find_bounds(s);
    const std::vector<gpu_layout::Instance> instances = packed_instances(s);
    if (!instances.empty()) s.device->upload(s.instances, std::as_bytes(std::span(instances)));
    s.casters = {};
    s.tlas = {};
    for (const uint32_t mesh : deformed)
        if (mesh < s.blas.size()) s.blas[mesh] = {};
    s.content = std::make_shared<char>();
    if (!deformed.empty()) s.shapes = std::make_shared<char>();
}

SceneGpu::~SceneGpu() = default;
const scene::Scene& SceneGpu::scene() const { return *impl_->scene; }
gpu::Device& SceneGpu::device() const { return *impl_->device; }
const Bounds& SceneGpu::bounds() const { return impl_->bounds; }
bool SceneGpu::has(DrawSet set) const { return (impl_->sets & set) != 0; }
bool SceneGpu::emits() const { return impl_->emits; }
gpu::Buffer& SceneGpu::positions() { return impl_->positions; }
gpu::Buffer& SceneGpu::attributes() { return impl_->attributes; }
gpu::Buffer& SceneGpu::indices() { return impl_->indices; }
gpu::Buffer& SceneGpu::instances() { return impl_->instances; }
gpu::Buffer& SceneGpu::materials() { return impl_->materials; }
gpu::Buffer& SceneGpu::previous_positions() { return impl_->previous ? impl_->previous : impl_->positions; }
gpu::Buffer& SceneGpu::previous_instances() { return impl_->previous_instances ? impl_->previous_instances : impl_->instances; }
const gpu::TextureTable& SceneGpu::textures() const { return impl_->textures; }
std::shared_ptr<const void> SceneGpu::content() const { return impl_->content; }
std::shared_ptr<const void> SceneGpu::shapes() const { return impl_->shapes; }
const SceneGpu::MeshRange& SceneGpu::range(size_t mesh) const { return impl_->ranges[mesh]; }
void SceneGpu::set_filter(Filter filter) { impl_->filter = std::move(filter); }

} // namespace gnomon::shadow
