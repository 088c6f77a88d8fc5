// SPDX-License-Identifier: Apache-2.0
// Sequences from the command line and in experiments.
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace gnomon::tests {
namespace {

using Json = nlohmann::json;

TEST(Motion, CompareWritesWhatItMeasured)
{
    Scratch scratch;
    const Finished run = run_gnomon({"compare", "contact", "--techniques", "shadow_map:map_size=128,ray_traced", "--size", "48x27",
                                        "--repeats", "1", "--motion", "camera,right=0.05,frames=4", "-o", "c"},
        scratch.folder());
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find("camera,right=0.05,frames=4"), std::string::npos) << run.out;
    const Json results = Json::parse(read_whole(scratch / "c/results.json")), &moving = results.at("runs")[0];
    for (const char* metric : {"flicker", "swimming", "popping"}) EXPECT_TRUE(moving.at("metrics").contains(metric)) << metric;
    EXPECT_EQ(moving.at("sequence").at("motion"), "camera,right=0.05,frames=4");
    ASSERT_EQ(moving.at("frames").size(), 4u);
    EXPECT_FALSE(moving.at("frames")[0].contains("change"));
    EXPECT_GT(moving.at("frames")[3].at("change").get<double>(), 0.0);
    // the first frame is the picture that is measured and timed
    EXPECT_NEAR(moving.at("frames")[0].at("mae").get<double>(), moving.at("metrics").at("mae").get<double>(), 1e-9);
    EXPECT_NE(read_whole(scratch / "c/results.csv").find("swimming"), std::string::npos);
    const std::string page = read_whole(scratch / "c/index.html");
    EXPECT_NE(page.find("\"change\":\"sun.shadow_map.change.png\""), std::string::npos);
    EXPECT_NE(page.find("that the next frame takes back"), std::string::npos) << "help of a metric";
}

TEST(Motion, WhatCannotMoveIsASentence)
{
    Scratch scratch;
    const auto compare = [&](const char* motion, const char* light) {
        return run_gnomon(
            {"compare", "plane", "--techniques", "ray_traced", "--size", "16x9", "--light", light, "--motion", motion, "-o", "c"},
            scratch.folder());
    };
    expect_sentence(compare("camra", "sun"), 1, {"motion 'camra'", "'camera'"});
    expect_sentence(compare("camera,frames=1", "sun"), 1, {"frames is 1", "3 to 64"});
    expect_sentence(compare("time", "sun"), 1, {"nothing of plane moves"});
    expect_sentence(compare("light,azimuth=1", "point,position=0/3/0"), 1, {"azimuth", "point"});
}

TEST(Motion, ExperimentsHaveMotions)
{
    Scratch scratch;
    const auto sweep = [&](const char* motion) {
        std::ofstream(scratch / "e.json") << R"({"scene": "contact", "size": "32x18", "truth_samples": 1, "repeats": 1,
            "technique": "shadow_map:map_size=128", "metrics": ["mae", "swimming"], "axes": {"path": ["still", "camera"]}, "motion": ")"
                                          << motion << R"("})";
        return run_gnomon({"sweep", "e.json", "-o", "out"}, scratch.folder());
    };
    expect_sentence(sweep("$path,fraems=3"), 1, {"unknown key 'fraems'", "'frames'"});
    const Finished made = sweep("$path,frames=3");
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string csv = read_whole(scratch / "out/results.csv");
    EXPECT_NE(csv.find("swimming"), std::string::npos);
    EXPECT_NE(read_whole(scratch / "out/results.jsonl").find("camera,right="), std::string::npos);
    EXPECT_NE(read_whole(scratch / "out/results.jsonl").find("still,frames=3"), std::string::npos);
}

} // namespace
} // namespace gnomon::tests
