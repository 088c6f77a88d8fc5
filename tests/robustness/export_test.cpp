// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>

#include <fstream>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;

size_t entries(const fs::path& folder) { return size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator())); }

TEST(ExportCommand, RefusesWithOneSentenceAndLeavesNothing)
{
    const Scratch scratch;
    const std::string out = scratch / "out";
    expect_sentence(run_gnomon({"export", "shadow_mop", "--to", "glsl", "-o", out}, scratch.folder()), 1, {"shadow_mop", "shadow_map"});
    expect_sentence(run_gnomon({"export", "shadow_map", "--to", "wgsl", "-o", out}, scratch.folder()), 1, {"wgsl", "spirv"});
    expect_sentence(run_gnomon({"export", "shadow_map", "--to", "glsl", "-o", out, "--light", "disk"}, scratch.folder()), 1, {"disk"});
    expect_sentence(
        run_gnomon({"export", "shadow_map", "--to", "glsl", "-o", out, "--set", "pcf"}, scratch.folder()), 1, {"NAME=VALUE", "pcf"});
    expect_sentence(run_gnomon({"export", "shadow_map", "--to", "glsl", "-o", out, "--set", "pcf=99"}, scratch.folder()), 1, {"pcf", "15"});
    expect_sentence(run_gnomon({"export", "shadow_map", "--to", "glsl"}, scratch.folder()), 2, {"--output"});
    EXPECT_FALSE(fs::exists(out));
}

TEST(ExportCommand, TouchesNoFolderThatHoldsSomethingElse)
{
    const Scratch scratch;
    fs::create_directory(scratch / "mine");
    std::ofstream(scratch / "mine" / "letter.txt") << "dear";
    expect_sentence(run_gnomon({"export", "shadow_map", "--to", "spirv", "-o", scratch / "mine"}, scratch.folder()), 1, {"mine", "empty"});
    EXPECT_EQ(entries(scratch / "mine"), 1u);
    expect_sentence(run_gnomon({"export", "shadow_map", "--to", "spirv", "-o", scratch / "mine" / "letter.txt"}, scratch.folder()), 1,
        {"letter.txt", "file"});
    // nobody, not even root, makes folders there
    expect_sentence(run_gnomon({"export", "shadow_map", "--to", "spirv", "-o", "/proc/gnomon/out"}, scratch.folder()), 1, {"/proc"});
}

TEST(ExportCommand, WritesAndReplacesWholeFolders)
{
    const Scratch scratch;
    const fs::path out = scratch / "out";
    const Finished first = run_gnomon({"export", "shadow_map", "--to", "glsl", "-o", out.string() + "/"}, scratch.folder());
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_TRUE(fs::exists(out / "shadow_map_resolve.frag.glsl"));
    EXPECT_TRUE(fs::exists(out / "README.md"));
    const Finished second = run_gnomon({"export", "shadow_map", "--to", "spirv", "-o", out, "--json"}, scratch.folder());
    ASSERT_EQ(second.code, 0) << second.err;
    EXPECT_TRUE(fs::exists(out / "shadow_map_resolve.frag.spv"));
    EXPECT_FALSE(fs::exists(out / "shadow_map_resolve.frag.glsl")) << "of the export before";
    for (const auto& entry : fs::directory_iterator(scratch.folder()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".out-")) << "a half-made folder is left: " << entry.path();
    EXPECT_EQ(read_whole(out / "passes.json").find(scratch.folder().string()), std::string::npos);
}

} // namespace
} // namespace gnomon::tests
