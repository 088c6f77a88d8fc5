// SPDX-License-Identifier: Apache-2.0
#include "shadows.h"

#include <algorithm>

namespace host {

Shadows::Shadows(const Gpu& gpu, const Scene& scene, const Convention& convention, const std::vector<std::string>& techniques,
    const std::string& settings)
    : scene_(scene)
    , convention_(convention)
{
    // 1. Gnomon joins the host's device, on which gnomon_require's features are enabled (vulkan.cpp).
    gnomon_device_info info{};
    info.get_instance_proc_addr = vkGetInstanceProcAddr;
    info.instance = gpu.instance;
    info.physical_device = gpu.physical;
    info.device = gpu.device;
    info.queue_family = gpu.queue_family;
    info.extensions = gpu.extensions.data();
    info.extension_count = uint32_t(gpu.extensions.size());
    info.pipeline_cache = gpu.pipeline_cache;
    device_ = gnomon::Device(info);

    // 2. The casters, where they are: in the host's own vertex and index buffers.
    create_scene();

    // 3. A shadow is a technique for one light of a scene.
    for (const std::string& technique : techniques) shadows_.emplace_back(casters_, technique, settings);
}

void Shadows::create_scene()
{
    gnomon_material material{};
    material.kind = GNOMON_OPAQUE;

    std::vector<gnomon_mesh> meshes;
    for (const Mesh& m : scene_.meshes) {
        gnomon_mesh mesh{};
        mesh.vertices = {scene_.vertices.buffer, VkDeviceSize(m.first_vertex) * scene_.stride, scene_.stride, scene_.position_format};
        mesh.indices = {scene_.indices.buffer, VkDeviceSize(m.first_index) * 2, 2, VK_FORMAT_R16_UINT};
        mesh.vertex_count = m.vertex_count;
        mesh.index_count = m.index_count;
        std::copy_n(m.lower, 3, mesh.lower);
        std::copy_n(m.upper, 3, mesh.upper);
        mesh.clockwise = convention_.clockwise;
        // Only techniques that say needs_vertices read these; an engine that uses none of them leaves both out.
        mesh.positions = m.positions.data();
        mesh.triangles = m.triangles.data();
        meshes.push_back(mesh);
    }

    const std::vector<InstanceData> posed = scene_.pose(0);
    std::vector<gnomon_instance> instances;
    for (size_t i = 0; i < posed.size(); ++i) instances.push_back({scene_.instances[i], posed[i].host_from_object});

    gnomon_scene_info info{};
    info.space = {convention_.up, convention_.left_handed, convention_.metres};
    info.materials = &material;
    info.material_count = 1;
    info.meshes = meshes.data();
    info.mesh_count = uint32_t(meshes.size());
    info.instances = instances.data();
    info.instance_count = uint32_t(instances.size());
    casters_ = gnomon::Scene(device_, info);
}

namespace {

gnomon_light to_gnomon(const Light& light)
{
    gnomon_light out{};
    out.kind = light.lamp ? GNOMON_SPOT : GNOMON_DIRECTIONAL;
    const float position[3] = {light.position.x, light.position.y, light.position.z};
    const float direction[3] = {light.direction.x, light.direction.y, light.direction.z};
    std::copy_n(position, 3, out.position);
    std::copy_n(direction, 3, out.direction);
    out.radius = light.radius;
    out.inner_angle = light.inner_angle;
    out.outer_angle = light.outer_angle;
    return out;
}

gnomon_image to_gnomon(const Image& image, VkImageLayout layout)
{
    return {image.image, image.format, image.extent, image.samples, layout};
}

uint32_t encoding(Normals normals)
{
    switch (normals) {
    case Normals::bytes:
        return GNOMON_NORMAL_UNSIGNED;
    case Normals::octahedral:
        return GNOMON_NORMAL_OCTAHEDRAL;
    case Normals::none:
    case Normals::floats:
        break;
    }
    return GNOMON_NORMAL_SIGNED;
}

struct Culling {
    const Scene& scene;
    const std::vector<InstanceData>& posed;
};
// Called by C code: nothing may be thrown.
VkBool32 may_cast(void* user, uint32_t instance, const float (*planes)[4], uint32_t plane_count)
{
    const Culling& culling = *static_cast<const Culling*>(user);
    return culling.scene.touches(instance, culling.posed, planes, plane_count);
}

} // namespace

uint64_t Shadows::record(size_t technique, const Request& r)
{
    // 4. What has moved since the last frame.
    for (uint32_t i = 0; i < r.posed.size(); ++i) casters_.move(i, r.posed[i].host_from_object);

    // 5. The frame, in the host's terms.
    gnomon_frame frame{};
    frame.commands = r.commands;
    std::copy(r.view.view_from_host.begin(), r.view.view_from_host.end(), frame.view_from_world);
    std::copy(r.view.clip_from_view.begin(), r.view.clip_from_view.end(), frame.clip_from_view);
    frame.y_up = convention_.y_up;
    frame.index = r.frame;
    frame.light = to_gnomon(r.light);
    frame.depth = to_gnomon(r.depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    frame.background = convention_.reversed_depth ? 0.0f : 1.0f;
    if (r.normals) frame.normals = to_gnomon(*r.normals, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    // Ours are smooth, with no normal map in them, so that they also serve to keep surfaces off their own shadow.
    frame.normal_encoding = encoding(convention_.normals) | GNOMON_NORMAL_GEOMETRIC;
    frame.output = to_gnomon(r.visibility, VK_IMAGE_LAYOUT_UNDEFINED); // written whole, and left in SHADER_READ_ONLY_OPTIMAL
    Culling culling{scene_, r.posed};
    frame.cull = may_cast;
    frame.cull_user = &culling;
    return shadows_[technique].record(frame);
}

void Shadows::destroyers(std::vector<std::function<void()>>& out)
{
    out.push_back([this] { device_ = {}; });
    out.push_back([this] { casters_ = {}; });
    for (gnomon::Shadow& shadow : shadows_) out.push_back([&shadow] { shadow = {}; });
}

} // namespace host
