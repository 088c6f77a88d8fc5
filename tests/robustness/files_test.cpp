// SPDX-License-Identifier: Apache-2.0
#include "process.h"
#include "tests/source_root.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

fs::path shared_folder()
{
    const char* given = std::getenv("GNOMON_SHARED");
    return given ? fs::path(given) : source_root() / ".." / "shared";
}

/// Made, or refused with one line that names the file: never a crash.
void expect_made_or_refused(const std::string& command, const fs::path& file, const Scratch& scratch)
{
    SCOPED_TRACE(command + " " + file.filename().string());
    const Finished f = run_gnomon({command, file, "--size", "64x48", "-o", scratch / "made.exr"}, scratch.folder(), {.seconds = 20});
    if (f.code == 0)
        EXPECT_GT(fs::file_size(scratch / "made.exr"), 0u);
    else
        expect_sentence(f, 1, {file.filename().string()});
}

TEST(Files, MalformedScenesAreRefusedOrRepaired)
{
    const fs::path folder = shared_folder() / "scenes" / "malformed";
    if (!fs::is_directory(folder)) GTEST_SKIP() << "no malformed files in " << folder << "; set GNOMON_SHARED";
    const Scratch scratch;
    size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
        expect_made_or_refused("truth", entry.path(), scratch);
        expect_made_or_refused("render", entry.path(), scratch);
        ++files;
    }
    EXPECT_GT(files, 40u);
}

/// A glTF file of single triangles, three corners each.
fs::path write_triangles(const fs::path& file, const std::vector<float>& numbers)
{
    fs::path binary = file;
    binary.replace_extension(".bin");
    std::ofstream(binary, std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()), std::streamsize(numbers.size() * sizeof(float)));
    const std::string bytes = std::to_string(numbers.size() * sizeof(float)), count = std::to_string(numbers.size() / 3);
    std::ofstream(file) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": )"
                        << count << R"(, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]}],
        "bufferViews": [{"buffer": 0, "byteLength": )"
                        << bytes << R"(}], "buffers": [{"byteLength": )" << bytes << R"(, "uri": ")" << binary.filename().string()
                        << "\"}]}";
    return file;
}

TEST(Files, OddGeometryIsDrawnOrRefused)
{
    const Scratch scratch;
    const float nan = std::numeric_limits<float>::quiet_NaN(), huge = 3e38f, tiny = 1e-38f;
    const std::vector<float> good = {-1, 0, 1, 1, 0, 1, 0, 0, -1};
    const auto with = [&](std::vector<float> more) {
        more.insert(more.end(), good.begin(), good.end());
        return more;
    };
    const std::map<std::string, std::vector<float>> odd = {
        {"nan_alone.gltf", std::vector<float>(9, nan)},
        {"nan_corner.gltf", with({0, 1, 0, nan, 1, 0, 0, 1, 1})},
        {"infinite_corner.gltf", with({0, 1, 0, INFINITY, 1, 0, 0, 1, 1})},
        {"no_area_alone.gltf", std::vector<float>(9, 0.5f)},
        {"no_area.gltf", with({0, 1, 0, 1, 1, 0, 2, 1, 0})},
        {"huge.gltf", with({-huge, 1, -huge, huge, 1, -huge, 0, 1, huge})},
        {"tiny.gltf", {-tiny, 0, tiny, tiny, 0, tiny, 0, 0, -tiny}},
        {"far.gltf", {1e7f, 0, 1e7f, 1e7f + 1, 0, 1e7f, 1e7f, 0, 1e7f - 1}},
        {"partial.gltf", {0, 1, 0, 1}},
    };
    for (const auto& [name, numbers] : odd) {
        const fs::path file = write_triangles(scratch / name, numbers);
        expect_made_or_refused("truth", file, scratch);
        expect_made_or_refused("render", file, scratch);
    }
    EXPECT_EQ(run_gnomon({"truth", scratch / "nan_corner.gltf", "--size", "16x16", "-o", "a.exr"}, scratch.folder()).code, 0)
        << "the good triangle is kept";
    EXPECT_EQ(run_gnomon({"truth", scratch / "no_area.gltf", "--size", "16x16", "-o", "b.exr"}, scratch.folder()).code, 0)
        << "the good triangle is kept";
}

TEST(Files, WhatIsNoSceneIsNamed)
{
    const Scratch scratch;
    std::ofstream(scratch / "empty.json");
    std::ofstream(scratch / "wrong.json") << R"({"model": 3})";
    std::ofstream(scratch / "cut.json") << R"({"model": "balls", "cameras": [{"eye": [1, 2)";
    std::ofstream(scratch / "deep.json") << std::string(100000, '[');
    std::ofstream(scratch / "picture.png") << "no scene";
    fs::create_directories(scratch / "folder.glb");
    for (const char* name :
        {"empty.json", "wrong.json", "cut.json", "deep.json", "picture.png", "folder.glb", "missing.glb", "missing/there.gltf"})
        for (const char* command : {"truth", "render"}) {
            SCOPED_TRACE(command);
            expect_sentence(run_gnomon({command, name, "--size", "8x8"}, scratch.folder()), 1, {name});
        }
    expect_sentence(run_gnomon({"convert", "missing.json"}, scratch.folder()), 1, {"missing.json"});
    expect_sentence(run_gnomon({"convert", "deep.json"}, scratch.folder()), 1, {"deep.json"});
}

const std::vector<std::string> truth_of_citadel
    = {"truth", "citadel", "--size", "768x512", "--light", "sun,angle=4", "--samples", "4", "-o", "target.exr"};

TEST(Files, SameInputGivesTheSameBytes)
{
    const Scratch scratch;
    std::vector<std::string> files;
    for (const char* cache : {"one", "two", "two"}) { // traced, traced again, read from the cache
        EXPECT_EQ(run_gnomon(truth_of_citadel, scratch.folder(), {.environment = {{"GNOMON_CACHE", scratch / cache}}}).code, 0);
        files.push_back(read_whole(scratch / "target.exr") + read_whole(scratch / "target.png"));
    }
    EXPECT_GT(files[0].size(), 10000u);
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], files[2]);
}

TEST(Files, AKilledRunLeavesNoPartOfAFile)
{
    const Scratch scratch;
    const Finished whole = run_gnomon(truth_of_citadel, scratch.folder());
    ASSERT_EQ(whole.code, 0) << whole.err;
    const Finished cached = run_gnomon(truth_of_citadel, scratch.folder());
    const std::string expected = read_whole(scratch / "target.exr"), expected_png = read_whole(scratch / "target.png");
    std::mt19937 random(1);
    int killed = 0, absent = 0;
    for (int i = 0; i < 16; ++i) {
        fs::remove(scratch / "target.exr");
        fs::remove(scratch / "target.png");
        const auto begin = std::chrono::steady_clock::now();
        // half of them at any moment, half just after the temporary file is there
        const double moment = std::uniform_real_distribution<double>(0.2, 1.0)(random) * cached.seconds;
        const auto now = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >= moment; };
        const auto writing = [&] {
            for (const fs::directory_entry& e : fs::directory_iterator(scratch.folder()))
                if (e.path().extension() == ".tmp") return true;
            return false;
        };
        RunOptions options;
        if (i % 2)
            options.kill_when = writing;
        else
            options.kill_when = now;
        const Finished f = run_gnomon(truth_of_citadel, scratch.folder(), options);
        killed += f.signal == SIGKILL;
        for (const auto& [name, bytes] : {std::pair{"target.exr", &expected}, {"target.png", &expected_png}}) {
            absent += !fs::exists(scratch / name);
            if (!fs::exists(scratch / name)) continue;
            EXPECT_TRUE(read_whole(scratch / name) == *bytes) << name << " in part, run " << i;
        }
        for (const fs::directory_entry& e : fs::directory_iterator(scratch.folder()))
            if (e.path().extension() == ".tmp") fs::remove(e.path());
    }
    EXPECT_GT(killed, 0);
    EXPECT_GT(absent, 0);
}

} // namespace
} // namespace gnomon::tests
