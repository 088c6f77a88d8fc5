// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

namespace gnomon::tests {
namespace {

void append(std::string& bytes, const void* data, size_t size) { bytes.append(static_cast<const char*>(data), size); }

/// A rolling field of `side` x `side` quads with normals and 32-bit indices; returns the bytes of vertices and indices.
size_t write_field(const std::filesystem::path& file, uint32_t side)
{
    std::string data;
    const uint32_t row = side + 1;
    for (uint32_t y = 0; y < row; ++y)
        for (uint32_t x = 0; x < row; ++x) {
            const float p[3]
                = {float(x) / float(side), 0.02f * std::sin(0.05f * float(x)) * std::cos(0.05f * float(y)), float(y) / float(side)};
            append(data, p, sizeof p);
        }
    const size_t normals = data.size();
    const float up[3] = {0, 1, 0};
    for (uint32_t i = 0; i < row * row; ++i) append(data, up, sizeof up);
    const size_t indices = data.size();
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t a = y * row + x, quad[6] = {a, a + row, a + 1, a + 1, a + row, a + row + 1};
            append(data, quad, sizeof quad);
        }
    std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}},"indices":2}}]}}],)"
        R"("buffers":[{{"byteLength":{}}}],"bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[0,-1,0],"max":[1,1,1]}},{{"bufferView":1,"componentType":5126,"count":{},"type":"VEC3"}},{{"bufferView":2,"componentType":5125,"count":{},"type":"SCALAR"}}]}})",
        data.size(), normals, normals, indices - normals, indices, data.size() - indices, row * row, row * row, 6 * side * side);
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string glb = "glTF";
    const auto word = [&](size_t v) {
        const uint32_t w = uint32_t(v);
        append(glb, &w, 4);
    };
    word(2), word(12 + 8 + json.size() + 8 + data.size());
    word(json.size()), word(0x4e4f534a), glb += json;
    word(data.size()), word(0x004e4942);
    std::ofstream out(file, std::ios::binary);
    out.write(glb.data(), std::streamsize(glb.size()));
    out.write(data.data(), std::streamsize(data.size()));
    return data.size();
}

TEST(Large, AMillionTrianglesStayWithinSixTimesTheirBytes)
{
    const Scratch scratch;
    const size_t bytes = write_field(scratch / "field.glb", 708);
    const Finished f = run_gnomon({"render", (scratch / "field.glb").string(), "--size", "320x240", "-o", (scratch / "field.png").string()},
        scratch.folder(), {.seconds = 300});
    ASSERT_EQ(f.code, 0) << f.err;
    RecordProperty("peak_mib", std::to_string(f.peak_memory >> 20));
    EXPECT_LT(f.peak_memory, 6 * bytes + (size_t(300) << 20))
        << (f.peak_memory >> 20) << " MiB for " << (bytes >> 20) << " MiB of vertices and indices";
}

} // namespace
} // namespace gnomon::tests
