// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "technique_fixture.h"

#include "host/space.h"
#include "scene/load.h"

#include <gnomon/gnomon.hpp>

#include <atomic>
#include <cmath>
#include <map>

namespace gnomon::gpu {

/// How a renderer sees the world; each of these must show the same shadows.
struct Conventions {
    gnomon_space space{1, VK_FALSE, 1.0f};
    bool reversed = true, y_up = false, snorm = false, short_indices = false, clockwise = false, doubled_samples = false;
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
    glm::dvec3 origin{0}; ///< where Gnomon's lies in the host's space, host units
};

/// A renderer with buffers, images and commands of its own: it shares Gnomon's test device, and hands the library nothing but handles.
class HostTest : public TechniqueTest {
protected:
    static gnomon_device_info device_info(PFN_vkGetInstanceProcAddr get = ::vkGetInstanceProcAddr)
    {
        static const char* extensions[] = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME};
        const bool rays = device().supports(extensions[0]) && device().supports(extensions[1]);
        return {GNOMON_VERSION, get, device().instance(), device().physical(), device().handle(), device().queue_family(), extensions,
            rays ? 2u : 0u, VK_NULL_HANDLE};
    }

    template <class Function> static Function call(const char* name)
    {
        const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(::vkGetInstanceProcAddr(device().instance(), "vkGetDeviceProcAddr"));
        return reinterpret_cast<Function>(get(device().handle(), name));
    }

    /// The command buffers of a renderer, each used once.
    class Commands {
    public:
        Commands()
        {
            const VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, device().queue_family()};
            call<PFN_vkCreateCommandPool>("vkCreateCommandPool")(device().handle(), &info, nullptr, &pool_);
        }
        ~Commands() { call<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(device().handle(), pool_, nullptr); }
        Commands(const Commands&) = delete;
        Commands& operator=(const Commands&) = delete;
        VkCommandBuffer begin()
        {
            const VkCommandBufferAllocateInfo info{
                VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
            VkCommandBuffer commands;
            call<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(device().handle(), &info, &commands);
            const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
            call<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, &begin);
            return commands;
        }
        static void finish(VkCommandBuffer commands) ///< submits and waits
        {
            call<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands);
            VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
            submit.commandBufferCount = 1;
            submit.pCommandBuffers = &commands;
            ASSERT_EQ(call<PFN_vkQueueSubmit>("vkQueueSubmit")(device().queue(), 1, &submit, VK_NULL_HANDLE), VK_SUCCESS);
            ASSERT_EQ(call<PFN_vkQueueWaitIdle>("vkQueueWaitIdle")(device().queue()), VK_SUCCESS);
        }

    private:
        VkCommandPool pool_ = VK_NULL_HANDLE;
    };

    /// A scene as the host has it.
    struct HostScene {
        std::vector<Buffer> buffers;
        std::vector<gnomon_mesh> meshes;
        std::vector<gnomon_material> materials;
        std::vector<gnomon_instance> instances;
        gnomon_scene_info info{};
    };

    static glm::dmat4 host_from_world(const Conventions& c) { return glm::inverse(host::world_from_host(c.space, c.origin)); }

    static VkTransformMatrixKHR rows_of(const glm::dmat4& m)
    {
        VkTransformMatrixKHR out;
        for (int r = 0; r < 3; ++r)
            for (int k = 0; k < 4; ++k) out.matrix[r][k] = float(m[k][r]);
        return out;
    }

    /// `vertices`: hands over the positions in host memory too.
    static HostScene host_scene(const scene::Scene& s, const Conventions& c, bool vertices)
    {
        HostScene out;
        for (const scene::Material& m : s.materials)
            out.materials.push_back(
                {uint32_t(m.alpha), {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w}, m.alpha_cutoff, m.double_sided});
        for (const scene::Mesh& mesh : s.meshes) add_mesh(out, mesh, c, vertices);
        for (const scene::Instance& i : s.instances) {
            const glm::dmat4 object = ours_from_hosts(s.meshes[size_t(i.mesh)], c);
            out.instances.push_back({uint32_t(i.mesh), rows_of(host_from_world(c) * glm::dmat4(i.world_from_object) * object)});
        }
        out.info = {c.space, out.materials.data(), out.meshes.data(), out.instances.data(), uint32_t(out.materials.size()),
            uint32_t(out.meshes.size()), uint32_t(out.instances.size())};
        return out;
    }

    /// The host's view of the world; `near` and `far` bound what a depth that is not reversed holds.
    static void aim(gnomon_frame& frame, const scene::Camera& camera, Size size, const Conventions& c, double near, double far)
    {
        const scene::View view = scene::make_view(camera, size, {});
        // any rigid change of the camera's own axes may stand between the two matrices
        glm::dmat4 turned(0.0);
        turned[2][0] = 1, turned[0][1] = 1, turned[1][2] = -1, turned[3][3] = 1;
        const glm::dmat4 view_from_host = turned * glm::dmat4(view.view_from_world) * glm::inverse(host_from_world(c));
        glm::dmat4 clip(view.clip_from_view);
        // rows 2 and 3 of the projection: depth from z of Gnomon's view space, which looks along -z
        const double a = c.reversed ? 0.0 : -far / (far - near), b = c.reversed ? near : -near * far / (far - near);
        for (int k = 0; k < 4; ++k) clip[k][2] = k == 2 ? a : k == 3 ? b : 0.0;
        if (c.y_up)
            for (int k = 0; k < 4; ++k) clip[k][1] = -clip[k][1];
        const glm::dmat4 clip_from_view = clip * glm::inverse(turned);
        for (int i = 0; i < 16; ++i)
            frame.view_from_world[i] = float(view_from_host[i / 4][i % 4]), frame.clip_from_view[i] = float(clip_from_view[i / 4][i % 4]);
        frame.y_up = c.y_up, frame.background = c.reversed ? 0.0f : 1.0f;
    }

    /// A light of the scene in the host's words.
    static gnomon_light host_light(const scene::Light& light, const Conventions& c)
    {
        const glm::dmat4 m = host_from_world(c);
        gnomon_light out{};
        out.kind = uint32_t(light.kind());
        const auto put = [](float(&to)[3], const glm::dvec3& v) { to[0] = float(v.x), to[1] = float(v.y), to[2] = float(v.z); };
        const auto point = [&](vec3 p) { return glm::dvec3(m * glm::dvec4(glm::dvec3(p), 1.0)); };
        const auto along = [&](vec3 v) { return glm::dmat3(m) * glm::dvec3(v); };
        const float scale = 1.0f / (c.space.metres_per_unit == 0.0f ? 1.0f : c.space.metres_per_unit);
        if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape))
            put(out.direction, 3.0 * along(sun->direction)), out.radius = sun->angular_radius;
        if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape)) {
            put(out.position, point(spot->position)), put(out.direction, along(spot->direction));
            out.inner_angle = spot->inner_angle, out.outer_angle = spot->outer_angle, out.radius = scale * spot->radius;
        }
        if (const auto* p = std::get_if<scene::PointLight>(&light.shape))
            put(out.position, point(p->position)), out.radius = scale * p->radius;
        if (const auto* disk = std::get_if<scene::DiskLight>(&light.shape))
            put(out.position, point(disk->centre)), put(out.direction, along(disk->normal)), out.radius = scale * disk->radius;
        if (const auto* rect = std::get_if<scene::RectLight>(&light.shape)) {
            put(out.position, point(rect->centre)), put(out.half_u, along(rect->half_u)), put(out.half_v, along(rect->half_v));
            put(out.direction, along(glm::cross(rect->half_u, rect->half_v)));
        }
        return out;
    }

    static gnomon_image host_image(Image& image, VkImageLayout layout)
    {
        const ImageDesc& d = image.desc();
        return {image.handle(), d.format, {uint32_t(d.size.width), uint32_t(d.size.height)}, d.samples, layout};
    }

private:
    /// The scene's object space from the host's: 16-bit positions lie in the box [-1, 1]^3, and meshes of a left-handed renderer are
    /// left-handed themselves.
    static glm::dmat4 ours_from_hosts(const scene::Mesh& mesh, const Conventions& c)
    {
        const glm::dmat4 handed = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1, c.space.left_handed ? -1 : 1));
        if (!c.snorm) return handed;
        const glm::dvec3 half = glm::max(0.5 * glm::dvec3(mesh.bounds.max - mesh.bounds.min), glm::dvec3(1e-6));
        return glm::translate(glm::dmat4(1.0), glm::dvec3(mesh.bounds.centre())) * glm::scale(glm::dmat4(1.0), half) * handed;
    }

    static void add_mesh(HostScene& out, const scene::Mesh& mesh, const Conventions& c, bool vertices)
    {
        const glm::dmat4 packed = glm::inverse(ours_from_hosts(mesh, c));
        const uint32_t stride = c.snorm ? 10 : 20, offset = c.snorm ? 2 : 8; // other things stand between positions
        std::vector<std::byte> bytes((mesh.positions.size() * stride + offset + 3) / 4 * 4);
        gnomon_mesh m{};
        for (size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::dvec3 p(packed * glm::dvec4(glm::dvec3(mesh.positions[v]), 1.0));
            const vec3 f(p);
            int16_t s[4] = {int16_t(std::lround(p.x * 32767)), int16_t(std::lround(p.y * 32767)), int16_t(std::lround(p.z * 32767)), 0};
            std::memcpy(bytes.data() + offset + v * stride, c.snorm ? static_cast<const void*>(s) : &f, c.snorm ? 8 : 12);
        }
        out.buffers.push_back(storage<std::byte>("vertices", bytes));
        m.vertices = {out.buffers.back().handle(), offset, stride, c.snorm ? VK_FORMAT_R16G16B16A16_SNORM : VK_FORMAT_R32G32B32_SFLOAT};
        std::vector<uint32_t> order = mesh.indices;
        if (c.clockwise)
            for (size_t i = 0; i + 2 < order.size(); i += 3) std::swap(order[i + 1], order[i + 2]);
        if (c.short_indices) {
            std::vector<uint16_t> shorts(order.begin(), order.end());
            shorts.insert(shorts.begin(), 7); // they begin in the middle of a word
            shorts.resize((shorts.size() + 1) / 2 * 2);
            out.buffers.push_back(storage<uint16_t>("indices", shorts));
        } else {
            out.buffers.push_back(storage<uint32_t>("indices", order));
        }
        m.indices = {out.buffers.back().handle(), c.short_indices ? 2u : 0u, 0, c.short_indices ? VK_FORMAT_R16_UINT : VK_FORMAT_R32_UINT};
        m.vertex_count = uint32_t(mesh.positions.size()), m.index_count = uint32_t(order.size()), m.material = uint32_t(mesh.material);
        const Bounds bounds = transformed(mesh.bounds, mat4(packed));
        for (int k = 0; k < 3; ++k) m.lower[k] = bounds.min[k], m.upper[k] = bounds.max[k];
        m.clockwise = c.clockwise;
        if (vertices && packed == glm::dmat4(1.0) && !c.clockwise) m.positions = &mesh.positions[0].x, m.triangles = mesh.indices.data();
        out.meshes.push_back(m);
    }
};

} // namespace gnomon::gpu
