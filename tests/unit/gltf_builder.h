// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "base/file.h"
#include "scene/load.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace gnomon::scene {

/// A folder of its own for one test, removed with it.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::temp_directory_path()
            / (std::string("gnomon-") + test->test_suite_name() + "-" + test->name() + "-" + std::to_string(::getpid()));
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

inline std::string base64(std::span<const std::byte> bytes)
{
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? uint32_t(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

/// A glTF document made in code, with all data in buffer 0. Change `json` at will.
class GltfBuilder {
public:
    using json = nlohmann::json;
    json doc = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", json::array()}}}}};
    std::vector<std::byte> data;

    template <class T> int view(const std::vector<T>& values)
    {
        while (data.size() % 4 != 0) data.push_back(std::byte(0));
        const auto bytes = std::as_bytes(std::span(values));
        const size_t offset = data.size();
        data.insert(data.end(), bytes.begin(), bytes.end());
        return push("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
    }
    int push(const char* collection, json value)
    {
        doc[collection].push_back(std::move(value));
        return int(doc[collection].size()) - 1;
    }
    int accessor(int buffer_view, const char* type, int component, size_t count, bool normalized = false)
    {
        json a = {{"bufferView", buffer_view}, {"type", type}, {"componentType", component}, {"count", count}};
        if (normalized) a["normalized"] = true;
        return push("accessors", a);
    }
    int scalars(const std::vector<float>& v) { return accessor(view(v), "SCALAR", 5126, v.size()); }
    int vec2s(const std::vector<vec2>& v) { return accessor(view(v), "VEC2", 5126, v.size()); }
    int vec3s(const std::vector<vec3>& v) { return accessor(view(v), "VEC3", 5126, v.size()); }
    int vec4s(const std::vector<vec4>& v) { return accessor(view(v), "VEC4", 5126, v.size()); }
    int indices(const std::vector<uint32_t>& v) { return accessor(view(v), "SCALAR", 5125, v.size()); }
    int mesh(json primitive) { return push("meshes", {{"primitives", json::array({std::move(primitive)})}}); }
    /// A node at the root of scene 0.
    int node(json value)
    {
        const int i = push("nodes", std::move(value));
        doc["scenes"][0]["nodes"].push_back(i);
        return i;
    }
    /// One counter-clockwise triangle in the plane z = 0, seen from +z: (0,0), (1,0), (0,1).
    int triangle(json more = json::object())
    {
        more["attributes"]["POSITION"] = vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        return mesh(std::move(more));
    }

    std::string gltf_text() const
    {
        json out = doc;
        if (!data.empty()) {
            json& buffer = out["buffers"][0];
            buffer["byteLength"] = data.size();
            buffer["uri"] = "data:application/octet-stream;base64," + base64(data);
        }
        return out.dump();
    }
    std::string glb_text() const
    {
        json out = doc;
        out["buffers"][0]["byteLength"] = data.size();
        std::string text = out.dump(), binary(reinterpret_cast<const char*>(data.data()), data.size());
        text.resize((text.size() + 3) / 4 * 4, ' ');
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        const auto word = [](size_t value) {
            std::string bytes(4, '\0');
            for (size_t i = 0; i < 4; ++i) bytes[i] = char(value >> (8 * i) & 255);
            return bytes;
        };
        return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text + word(binary.size())
            + std::string("BIN\0", 4) + binary;
    }
    /// Writes and loads it.
    Scene load(const LoadOptions& options = {}) const
    {
        TemporaryFolder folder;
        base::write_text(folder / "made.gltf", gltf_text());
        return load_gltf(folder / "made.gltf", options);
    }
    std::string load_error(const LoadOptions& options = {}) const
    {
        try {
            load(options);
        } catch (const base::Error& e) {
            return e.what();
        }
        return "";
    }
};

inline void expect_near(vec3 a, vec3 b, float tolerance = 1e-5f)
{
    EXPECT_LE(glm::length(a - b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") is not (" << b.x << ", " << b.y << ", "
                                             << b.z << ")";
}

/// Geometric normal of a placed triangle, world space: where its outside is.
inline vec3 outside(const Scene& scene, size_t instance, size_t triangle = 0)
{
    const Instance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshes[size_t(placed.mesh)];
    vec3 p[3];
    for (size_t k = 0; k < 3; ++k) p[k] = vec3(placed.world_from_object * vec4(mesh.positions[mesh.indices[triangle * 3 + k]], 1.0f));
    return glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
}

inline bool any_contains(const std::vector<std::string>& texts, const std::string& part)
{
    for (const std::string& text : texts)
        if (text.find(part) != std::string::npos) return true;
    return false;
}

} // namespace gnomon::scene
