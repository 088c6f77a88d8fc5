// SPDX-License-Identifier: Apache-2.0
// Scenes and pictures of a size that is large for this machine; in a short run they are smaller. And threads: their number changes no bit.
#include "process.h"
#include "tests/faults/reliability.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon::tests {
namespace {

using Json = nlohmann::json;

/// Works, or says why not in one sentence; how it went is recorded.
Finished try_limit(const std::string& limit, const std::vector<std::string>& words, const Scratch& scratch, double seconds)
{
    const Finished f = run_gnomon(words, scratch.folder(), {.seconds = seconds});
    if (f.code != 0) expect_sentence(f, 1, {});
    std::string outcome = f.code == 0 ? "works" : f.err.substr(0, f.err.find('\n'));
    if (f.timed_out || f.signal) outcome = fmt::format("**fails**: signal {}", f.signal);
    record("limits", {{"limit", limit}, {"outcome", outcome}, {"seconds", f.seconds}, {"peak_mib", double(f.peak_memory >> 20)}});
    return f;
}

TEST(ProgramLimits, TwelveMillionTriangles)
{
    const Scratch scratch;
    const Finished list = run_gnomon({"list", "--scenes", "--json"}, scratch.folder());
    ASSERT_EQ(list.code, 0) << list.err;
    const Json scenes = Json::parse(list.out);
    const double wanted = at_full_length() ? 12e6 : 12e4;
    for (const char* name : {"balls", "terrain"}) { // many placements of few meshes, and all triangles of one mesh its own
        const auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const Json& s) { return s.at("name") == name; });
        ASSERT_NE(scene, scenes.end());
        const std::string detail = std::to_string(wanted / scene->at("triangles").get<double>());
        for (const char* technique : {"shadow_map", "shadow_volumes", "ray_traced"}) {
            if (!at_full_length() && technique != std::string("shadow_map")) continue;
            std::filesystem::remove(scratch / "a.png");
            const Finished f = try_limit(fmt::format("{} of {:.0f} million triangles, {}", name, wanted / 1e6, technique),
                {"render", name, "--detail", detail, "--size", "320x240", "--technique", technique, "-o", scratch / "a.png"}, scratch,
                1500);
            EXPECT_EQ(f.code == 0, std::filesystem::exists(scratch / "a.png"));
        }
    }
}

TEST(ProgramLimits, EightThousandPixelsByTiles)
{
    const Scratch scratch;
    const std::string size = at_full_length() ? "7680x4320" : "768x432", tile = at_full_length() ? "2048" : "256";
    const Finished f = try_limit("a picture of " + size + " in tiles of " + tile,
        {"render", "contact", "--size", size, "--tile", tile, "--technique", "ray_traced", "--light", "sun,angle=0", "-o",
            scratch / "a.png"},
        scratch, 1500);
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_LT(f.peak_memory, uint64_t(at_full_length() ? 4096 : 900) << 20);
}

TEST(ProgramLimits, MapsBeyondTheDevice)
{
    const Scratch scratch;
    for (const char* size : {"32768", "65536"}) {
        const Finished f = try_limit(fmt::format("a shadow map of {0} x {0}", size),
            {"render", "plane", "--size", "16x12", "--technique", "shadow_map", "--shadow_map.map_size", size, "-o", scratch / "a.png"},
            scratch, 100);
        EXPECT_EQ(f.code, 1);
    }
    const Finished f
        = try_limit("a picture of 20000 x 20000", {"render", "plane", "--size", "20000x20000", "-o", scratch / "a.png"}, scratch, 100);
    EXPECT_EQ(f.code, 1);
    EXPECT_FALSE(std::filesystem::exists(scratch / "a.png"));
}

/// The least maps, grids and numbers of samples: instrumented shaders take lavapipe up to 10 us a texel.
std::vector<std::string> least_work(const Json& technique)
{
    std::vector<std::string> out;
    for (const Json& p : technique.at("parameters")) {
        const std::string name = p.at("name");
        if (!p.contains("range")) continue;
        const double least = p.at("range").at(0);
        if (least < 16 && name != "samples") continue; // 16 texels, cells or pages are the least of all maps, grids and pools
        out.push_back(fmt::format("--{}.{}", technique.at("id").get<std::string>(), name));
        out.push_back(fmt::format("{:.0f}", least));
    }
    return out;
}

TEST(GpuAssisted, EveryTechniqueOnce)
{
    if (!at_full_length() || GNOMON_SHADER_OPTIMISATION != std::string("-O0"))
        GTEST_SKIP() << "instrumented shaders take lavapipe a minute a technique, in a tree of their own: ./dev robustness runs them";
    const Scratch scratch;
    const Json list = Json::parse(run_gnomon({"list", "--json"}, scratch.folder()).out);
    for (const Json& t : list.at("techniques")) {
        const std::string id = t.at("id");
        if (!t.at("unavailable").get<std::string>().empty()) continue;
        // The layer reads the first itself: indices, descriptors and buffer addresses are checked while shaders run. The second keeps
        // lavapipe from optimising what is compiled for one frame: minutes a shader, else.
        std::vector<std::string> words = {"render", "plane", "--size", "8x8", "--validation", "--technique", id, "-o", scratch / "a.png"};
        for (const std::string& word : least_work(t)) words.push_back(word);
        const Finished f = run_gnomon(words, scratch.folder(),
            {.environment = {{"VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT"}, {"GALLIVM_PERF", "nopt"}},
                .seconds = 900});
        if (!f.timed_out) {
            EXPECT_EQ(f.signal, 0) << id;
            EXPECT_EQ(f.code, 0) << id << ": " << f.err;
        }
        record("checks",
            {{"check", "GPU-assisted validation"}, {"subject", id},
                {"outcome",
                    f.timed_out       ? "not through in 900 s"
                        : f.code == 0 ? "nothing found"
                                      : f.err.substr(0, 300)}});
    }
}

TEST(Threads, TheirNumberChangesNoBit)
{
    const Scratch scratch;
    const Json list = Json::parse(run_gnomon({"list", "--json"}, scratch.folder()).out);
    size_t techniques = 0;
    for (const Json& t : list.at("techniques")) {
        const std::string id = t.at("id");
        if (!t.at("unavailable").get<std::string>().empty()) continue;
        if (!at_full_length() && id != "virtual_shadow_map" && id != "per_triangle_volumes") continue;
        ++techniques;
        std::string first;
        bool same = true;
        for (const char* threads : {"2", "0", "1"}) {
            const Finished f
                = run_gnomon({"render", "contact", "--detail", "0.2", "--size", "128x96", "--technique", id, "-o", scratch / "a.exr"},
                    scratch.folder(), {.environment = {{"LP_NUM_THREADS", threads}}, .seconds = 300});
            ASSERT_EQ(f.code, 0) << id << ": " << f.err;
            const std::string bytes = read_whole(scratch / "a.exr");
            if (first.empty()) first = bytes;
            same &= bytes == first;
        }
        EXPECT_TRUE(same) << id;
        record("determinism", {{"technique", id}, {"how", "LP_NUM_THREADS 0, 1 and 2"}, {"pictures", 3}, {"failures", !same}});
    }
    EXPECT_GE(techniques, 2u);
}

} // namespace
} // namespace gnomon::tests
