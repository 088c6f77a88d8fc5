// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include "shapes.h"

#include <algorithm>
#include <cstring>
#include <numbers>

namespace host {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
enum { still, turning, circling, tumbling };

int16_t to_snorm16(float v) { return int16_t(std::lround(std::clamp(v, -1.0f, 1.0f) * 32767)); }
template <class T> void put(std::byte* to, const T& value) { std::memcpy(to, &value, sizeof(value)); }

float largest(const Shape& shape)
{
    float out = 0;
    for (const Shape::Vertex& v : shape.vertices)
        out = std::max({out, std::abs(v.position.x), std::abs(v.position.y), std::abs(v.position.z)});
    return out;
}

} // namespace

Scene::Scene(const Gpu& gpu, const Convention& convention)
    : convention_(convention)
{
    // 24 bytes a vertex: 16-bit position (w unused), 16-bit normal, two floats; else 32 with three floats for the position.
    const bool packed = convention.packed_vertices;
    position_format = packed ? VK_FORMAT_R16G16B16A16_SNORM : VK_FORMAT_R32G32B32_SFLOAT;
    normal_format = VK_FORMAT_R16G16B16A16_SNORM;
    uv_format = VK_FORMAT_R32G32_SFLOAT;
    stride = packed ? 24 : 32;
    normal_offset = packed ? 8 : 12;
    uv_offset = packed ? 16 : 20;

    store(gpu, {ground(12), box({0.35f, 1.5f, 0.35f}), torus(1.3f, 0.35f), ball(0.5f), box({0.05f, 0.7f, 0.05f})});
    enum { floor_mesh, column, ring, sphere, bar };
    placed_.push_back({floor_mesh, {}, {0.8f, 0.8f, 0.78f}, still});
    for (int i = 0; i < 6; ++i) {
        const float angle = float(i) / 6 * 2 * pi;
        placed_.push_back({column, {4 * std::cos(angle), 1.5f, 4 * std::sin(angle)}, {0.75f, 0.7f, 0.6f}, still});
    }
    placed_.push_back({ring, {0, 2, 0}, {0.8f, 0.35f, 0.2f}, tumbling});
    for (int i = 0; i < 3; ++i) placed_.push_back({sphere, {2.5f, 0.9f, float(i) * 2 * pi / 3}, {0.3f, 0.5f, 0.8f}, circling});
    for (int i = 0; i < 9; ++i) placed_.push_back({bar, {-2 + 0.5f * float(i), 0.7f, 5.2f}, {0.4f, 0.6f, 0.35f}, turning});
    for (const Placed& p : placed_) instances.push_back(p.mesh);
}

void Scene::store(const Gpu& gpu, const std::vector<Shape>& shapes)
{
    std::vector<std::byte> vertex_data;
    std::vector<uint16_t> index_data;
    for (const Shape& shape : shapes) {
        Mesh mesh{uint32_t(vertex_data.size() / stride), uint32_t(shape.vertices.size()), uint32_t(index_data.size()),
            uint32_t(shape.indices.size()), convention_.packed_vertices ? largest(shape) / convention_.metres : 1.0f, {1e30f, 1e30f, 1e30f},
            {-1e30f, -1e30f, -1e30f}, {}, {}};
        for (const Shape::Vertex& v : shape.vertices) {
            Vec3 p = convention_.point(v.position) * (1 / mesh.unpack);
            const Vec3 n = convention_.direction(v.normal);
            std::byte bytes[32] = {};
            if (convention_.packed_vertices) {
                const int16_t snorm[4] = {to_snorm16(p.x), to_snorm16(p.y), to_snorm16(p.z), 0};
                p = Vec3{float(snorm[0]), float(snorm[1]), float(snorm[2])} * (1 / 32767.0f); // what the device will read
                put(bytes, snorm);
            } else {
                put(bytes, p);
            }
            const int16_t normal[4] = {to_snorm16(n.x), to_snorm16(n.y), to_snorm16(n.z), 0};
            const float uv[2] = {v.u, v.v};
            put(bytes + normal_offset, normal);
            put(bytes + uv_offset, uv);
            vertex_data.insert(vertex_data.end(), bytes, bytes + stride);
            const float xyz[3] = {p.x, p.y, p.z};
            mesh.positions.insert(mesh.positions.end(), xyz, xyz + 3);
            for (int axis = 0; axis < 3; ++axis) {
                mesh.lower[axis] = std::min(mesh.lower[axis], xyz[axis]);
                mesh.upper[axis] = std::max(mesh.upper[axis], xyz[axis]);
            }
        }
        // Mirrored coordinates in a left-handed space look the same, so only the host's wish turns the order round.
        for (size_t i = 0; i < shape.indices.size(); i += 3)
            for (size_t corner : {size_t(0), size_t(convention_.clockwise ? 2 : 1), size_t(convention_.clockwise ? 1 : 2)}) {
                index_data.push_back(shape.indices[i + corner]);
                mesh.triangles.push_back(shape.indices[i + corner]);
            }
        meshes.push_back(std::move(mesh));
    }
    constexpr VkBufferUsageFlags shared = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; // Gnomon reads both
    vertices = gpu.buffer(vertex_data.size(), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | shared, vertex_data.data());
    indices = gpu.buffer(index_data.size() * 2, VK_BUFFER_USAGE_INDEX_BUFFER_BIT | shared, index_data.data());
}

std::vector<InstanceData> Scene::pose(float seconds) const
{
    const Mat3 axes = convention_.axes();
    std::vector<InstanceData> out;
    for (const Placed& p : placed_) {
        Vec3 at = p.at;
        Mat3 turn = rotation({0, 1, 0}, 0);
        if (p.motion == turning) turn = rotation({0, 1, 0}, seconds + p.at.x);
        if (p.motion == tumbling) turn = rotation(normalize({1, 0.4f, 0.2f}), 0.8f * seconds);
        if (p.motion == circling)
            at = {p.at.x * std::cos(seconds + p.at.z), p.at.y + 0.3f * std::sin(2 * seconds + p.at.z), p.at.x * std::sin(seconds + p.at.z)};
        const Mat3 host_turn = axes * turn * transposed(axes);
        const Vec3 host_at = convention_.point(at);
        InstanceData data{};
        const float s = meshes[p.mesh].unpack, t[3] = {host_at.x, host_at.y, host_at.z};
        for (int column = 0; column < 3; ++column) {
            const float values[3] = {host_turn[size_t(column)].x, host_turn[size_t(column)].y, host_turn[size_t(column)].z};
            for (int row = 0; row < 3; ++row) data.host_from_object.matrix[row][column] = values[row] * s;
        }
        for (int row = 0; row < 3; ++row) data.host_from_object.matrix[row][3] = t[row];
        data.color[0] = p.color.x, data.color[1] = p.color.y, data.color[2] = p.color.z, data.color[3] = p.mesh == 0 ? 1.0f : 0.0f;
        out.push_back(data);
    }
    return out;
}

Light Scene::light(float seconds, bool lamp) const
{
    const float angle = 2.3f + 0.25f * std::sin(0.7f * seconds);
    if (!lamp) return {false, {}, convention_.direction(normalize({-std::cos(angle), -1.1f, -std::sin(angle)})), 0.03f};
    const Vec3 position{4 * std::cos(angle), 7, 4 * std::sin(angle)};
    return {true, convention_.point(position), convention_.direction(normalize(Vec3{0, 0.5f, 0} - position)), 0.3f / convention_.metres,
        0.5f, 0.75f};
}

View Scene::view(float seconds, float aspect) const
{
    const float angle = 0.9f + 0.1f * seconds;
    const Vec3 eye{9 * std::cos(angle), 5, 9 * std::sin(angle)}, forward = normalize(Vec3{0, 0.8f, 0} - eye);
    const Vec3 right = normalize(cross(forward, {0, 1, 0})), up = cross(right, forward);
    // View space as engines have it: right-handed ones look along -z, left-handed ones along +z.
    const float ahead = convention_.left_handed ? 1.0f : -1.0f;
    const Vec3 rows[3] = {convention_.direction(right), convention_.direction(up), convention_.direction(forward) * ahead};
    const Vec3 origin = convention_.point(eye);
    View v{};
    for (size_t row = 0; row < 3; ++row) {
        v.view_from_host[row] = rows[row].x, v.view_from_host[4 + row] = rows[row].y, v.view_from_host[8 + row] = rows[row].z;
        v.view_from_host[12 + row] = -dot(rows[row], origin);
    }
    v.view_from_host[15] = 1;

    const float focal = 1 / std::tan(0.45f), near = 0.1f / convention_.metres, far = 100 / convention_.metres;
    v.clip_from_view[0] = focal / aspect;
    v.clip_from_view[5] = convention_.y_up ? focal : -focal;
    v.clip_from_view[10] = convention_.reversed_depth ? 0 : ahead * far / (far - near);
    v.clip_from_view[11] = ahead;
    v.clip_from_view[14] = convention_.reversed_depth ? near : -near * far / (far - near);
    return v;
}

bool Scene::touches(uint32_t instance, const std::vector<InstanceData>& posed, const float (*planes)[4], uint32_t count) const
{
    const Mesh& mesh = meshes[instances[instance]];
    const auto& m = posed[instance].host_from_object.matrix;
    const Vec3 lower{mesh.lower[0], mesh.lower[1], mesh.lower[2]}, upper{mesh.upper[0], mesh.upper[1], mesh.upper[2]};
    const Vec3 middle = (lower + upper) * 0.5f, half = (upper - lower) * 0.5f;
    const auto row = [&](int r) { return m[r][0] * middle.x + m[r][1] * middle.y + m[r][2] * middle.z + m[r][3]; };
    const Vec3 center{row(0), row(1), row(2)};
    const float radius = std::sqrt(dot(half, half)) * mesh.unpack;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 normal{planes[i][0], planes[i][1], planes[i][2]};
        if (dot(normal, center) + planes[i][3] < -radius * std::sqrt(dot(normal, normal))) return false;
    }
    return true;
}

} // namespace host
