// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// few techniques, so that a call takes seconds
const std::vector<std::string> few = {"--light", "sun,elevation=50,angle=0", "--size", "40x24", "--repeats", "2", "--without",
    "csm,evsm,lvsm,msm,esm,vsm,power_cdf,cssm,vssm,moment_soft,back_projection,occlusion_textures,light_sampling,pcss,blurred_depth,"
    "per_triangle_volumes,shadow_volumes,hybrid_map_volume,virtual_shadow_map"};

std::vector<std::string> advising(const std::vector<std::string>& scenes, const std::vector<std::string>& more)
{
    std::vector<std::string> words = {"advise"};
    for (const std::vector<std::string>& part : {scenes, few, more}) words.insert(words.end(), part.begin(), part.end());
    return words;
}

/// All that was left in the folder, but for what the test itself and the caches write.
std::vector<std::string> files_in(const Scratch& scratch)
{
    std::vector<std::string> out;
    for (const fs::directory_entry& e : fs::directory_iterator(scratch.folder()))
        if (!e.path().filename().string().starts_with(".")) out.push_back(e.path().filename());
    std::sort(out.begin(), out.end());
    return out;
}

void expect_measured(const Json& m, const std::string& metric)
{
    EXPECT_TRUE(m.at("technique").is_string());
    EXPECT_EQ(m.at("choice").get<std::string>().find(m.at("technique").get<std::string>()), 0u);
    EXPECT_TRUE(m.at("params").is_object());
    EXPECT_GE(m.at(metric).get<double>(), 0);
    EXPECT_GT(m.at("ms").get<double>(), 0);
    EXPECT_GE(m.at("mean_ms").get<double>(), m.at("ms").get<double>());
    EXPECT_GE(m.at("deviation_ms").get<double>(), 0);
    EXPECT_TRUE(m.at("bytes").is_number_unsigned());
    EXPECT_TRUE(m.at("within_budget").is_boolean());
}

TEST(Advise, ChoosesWithinTheBudgetAndSaysWhy)
{
    const Scratch scratch;
    const Finished found = run_gnomon(
        advising({"plane"}, {"--budget", "512MiB", "--budget", "1000x", "--exhaustive", "--json", "-o", "table.md"}), scratch.folder());
    ASSERT_EQ(found.code, 0) << found.err;
    const Json json = Json::parse(found.out);
    for (const char* key : {"scene", "camera", "light", "device", "driver", "commit", "metric", "reference"})
        EXPECT_FALSE(json.at(key).get<std::string>().empty()) << key;
    EXPECT_EQ(json.at("size"), Json({40, 24}));
    EXPECT_EQ(json.at("budget"), Json({"512MiB", "1000x"}));
    EXPECT_EQ(json.at("features").at("light"), "directional");
    EXPECT_GT(json.at("reference_ms"), 0);
    EXPECT_GE(json.at("candidates"), json.at("measured").size());
    EXPECT_GE(json.at("candidates"), json.at("techniques"));
    EXPECT_FALSE(json.contains("nothing"));
    expect_measured(json.at("choice"), "mae");
    expect_measured(json.at("best"), "mae");
    EXPECT_TRUE(json.at("choice").at("within_budget"));
    EXPECT_LE(json.at("choice").at("bytes"), 512u << 20);
    ASSERT_FALSE(json.at("front").empty());
    for (const Json& m : json.at("front")) {
        expect_measured(m, "mae");
        EXPECT_NE(std::find(json.at("measured").begin(), json.at("measured").end(), m), json.at("measured").end());
    }
    for (size_t i = 1; i < json.at("front").size(); ++i) {
        EXPECT_GE(json.at("front").at(i).at("ms"), json.at("front").at(i - 1).at("ms"));
        EXPECT_LT(json.at("front").at(i).at("mae"), json.at("front").at(i - 1).at("mae"));
    }
    EXPECT_FALSE(json.at("reasons").empty());
    for (const Json& l : json.at("left_out"))
        EXPECT_FALSE(l.at("what").get<std::string>().empty() || l.at("why").get<std::string>().empty());
    EXPECT_LE(json.at("regret"), 0.1);
    EXPECT_NE(read_whole(scratch / "table.md").find("Largest regret"), std::string::npos);
}

TEST(Advise, SaysWhatComesNearestAndWritesNothingWhereNothingKeepsTheBudget)
{
    const Scratch scratch;
    const Finished time = run_gnomon(advising({"plane"}, {"--budget", "0.001us", "-o", "table.md"}), scratch.folder());
    EXPECT_EQ(time.code, 1);
    EXPECT_NE(time.err.find("keeps the budget of 0.001us: nearest comes"), std::string::npos) << time.err;
    const Finished memory
        = run_gnomon(advising({"plane"}, {"--budget", "1B", "--json", "-o", "table.md", "--without", "ray_traced"}), scratch.folder());
    EXPECT_EQ(memory.code, 1);
    EXPECT_NE(memory.err.find("keeps the budget of 1B: nearest comes"), std::string::npos) << memory.err;
    const Json json = Json::parse(memory.out);
    EXPECT_FALSE(json.contains("choice"));
    EXPECT_NE(json.at("nothing").get<std::string>().find("nearest comes"), std::string::npos);
    EXPECT_EQ(files_in(scratch), std::vector<std::string>());
}

TEST(Advise, RefusesInASentence)
{
    const Scratch scratch;
    const auto said = [&](std::vector<std::string> words, int code = 1) {
        words.insert(words.begin(), "advise");
        const Finished f = run_gnomon(words, scratch.folder());
        EXPECT_EQ(f.code, code) << f.out;
        EXPECT_EQ(files_in(scratch), std::vector<std::string>());
        return f.err;
    };
    EXPECT_NE(said({"nowhere"}).find("unknown scene 'nowhere'"), std::string::npos);
    EXPECT_NE(said({"plane", "--budget", "4"}).find("lacks a unit"), std::string::npos);
    EXPECT_NE(said({"plane", "--budget", "-4ms"}).find("above 0"), std::string::npos);
    EXPECT_NE(said({"plane", "--metric", "maw"}).find("mae"), std::string::npos);
    EXPECT_NE(said({"plane", "--metric", "time"}).find("time is no error"), std::string::npos);
    EXPECT_NE(said({"plane", "--metric", "filter_leak", "--size", "16x16"}).find("reference technique"), std::string::npos);
    EXPECT_NE(said({"plane", "--prefer", "sharp"}).find("unknown preference"), std::string::npos);
    EXPECT_NE(said({"plane", "--prefer", "exact", "--prefer", "soft"}, 2).find("--prefer"), std::string::npos);
    EXPECT_NE(said({"plane", "--without", "pfc"}).find("pcf"), std::string::npos);
    EXPECT_NE(said({"plane", "--reference", "shadow_mop", "--budget", "2x"}).find("shadow_map"), std::string::npos);
    EXPECT_NE(said({"plane", "-o", "table.txt"}).find("no .md file"), std::string::npos);
    // nothing but rays is exact under a wide light
    const std::string none = said({"balls", "--light", "disk,position=0/4/0,target=0/0/0,radius=1", "--size", "64x36", "--prefer", "exact",
        "--without", "ray_traced"});
    EXPECT_NE(none.find("no technique fits this light, --prefer and --without"), std::string::npos) << none;
}

TEST(Advise, InterruptedLeavesNoPartOfAFile)
{
    const Scratch scratch;
    const std::vector<std::string> words = advising({"plane", "contact"}, {"--budget", "1000x", "-o", "table.md"});
    RunOptions early;
    early.signal = SIGINT;
    early.kill_when
        = [begin = std::chrono::steady_clock::now()] { return std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(300); };
    EXPECT_EQ(run_gnomon(words, scratch.folder(), early).signal, SIGINT);
    EXPECT_EQ(files_in(scratch), std::vector<std::string>());

    // the first scene's line is there, whole; that of the second never comes
    RunOptions between;
    between.signal = SIGINT;
    between.kill_when = [&] { return fs::exists(scratch / "table.md"); };
    EXPECT_EQ(run_gnomon(words, scratch.folder(), between).signal, SIGINT);
    EXPECT_EQ(files_in(scratch), std::vector<std::string>{"table.md"});
    const std::string table = read_whole(scratch / "table.md");
    EXPECT_NE(table.find("\n| plane |"), std::string::npos) << table;
    EXPECT_EQ(table.find("\n| contact |"), std::string::npos) << table;
    EXPECT_TRUE(table.ends_with("|\n")) << table;
}

} // namespace
} // namespace gnomon::tests
