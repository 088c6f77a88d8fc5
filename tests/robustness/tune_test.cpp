// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_scene(const Scratch& scratch)
{
    std::ofstream(scratch / "yard.json")
        << R"({"model": "balls", "tuning": true, "lights": [{"name": "noon", "type": "directional", "direction": [0.4, -1, 0.2]}]})";
}

std::vector<std::string> tuning(std::vector<std::string> more)
{
    std::vector<std::string> words = {"tune", "shadow_map:map_size=128", "yard.json", "--vary", "bias_scale,bias", "--size", "48x32",
        "--budget", "6", "-o", "yard.preset.json"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(Tune, WritesAPresetThatOtherCommandsTakeAndGoesOnFromItsRuns)
{
    const Scratch scratch;
    write_scene(scratch);
    const Finished first = run_gnomon(tuning({"--validate", "contact", "--json"}), scratch.folder());
    ASSERT_EQ(first.code, 0) << first.err;
    const Json preset = Json::parse(read_whole(scratch / "yard.preset.json"));
    EXPECT_EQ(preset.at("technique"), "shadow_map");
    EXPECT_EQ(preset.at("params").at("map_size"), 128);
    EXPECT_TRUE(preset.at("params").contains("bias_scale"));
    EXPECT_LE(preset.at("tuning").at("after"), preset.at("tuning").at("before"));
    EXPECT_EQ(preset.at("validation").at("places").size(), 1u);
    for (const char* key : {"device", "driver", "commit"}) EXPECT_FALSE(preset.at(key).get<std::string>().empty());

    const Finished again = run_gnomon(tuning({"--validate", "contact"}), scratch.folder());
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.out.find("\n0 runs were made now"), std::string::npos) << again.out;
    EXPECT_EQ(Json::parse(read_whole(scratch / "yard.preset.json")), preset);

    const Finished used
        = run_gnomon({"compare", "balls", "--techniques", "@yard.preset.json,shadow_map", "--size", "32x24", "--repeats", "1", "--json"},
            scratch.folder());
    ASSERT_EQ(used.code, 0) << used.err;
    EXPECT_EQ(Json::parse(used.out).at("runs").at(0).at("params").at("map_size"), 128);
    const Finished shown
        = run_gnomon({"render", "balls", "--technique", "@yard.preset.json", "--shadow_map.pcf", "1", "--size", "32x24", "-o", "a.png"},
            scratch.folder());
    EXPECT_EQ(shown.code, 0) << shown.err;
}

TEST(Tune, RefusesInASentence)
{
    const Scratch scratch;
    write_scene(scratch);
    const auto said = [&](std::vector<std::string> words, int code) {
        const Finished f = run_gnomon(words, scratch.folder());
        EXPECT_EQ(f.code, code) << f.out << f.err;
        EXPECT_FALSE(fs::exists(scratch / "yard.preset.json"));
        return f.err;
    };
    EXPECT_NE(said({"tune", "shadow_map", "balls", "-o", "p.json"}, 1).find("\"tuning\": true"), std::string::npos);
    EXPECT_NE(said({"tune", "shadow_map", "nowhere", "-o", "p.json"}, 1).find("nowhere"), std::string::npos);
    EXPECT_NE(said({"tune", "shadow_mop", "yard.json", "-o", "p.json"}, 1).find("shadow_map"), std::string::npos);
    EXPECT_NE(said(tuning({"--minimise", "leek"}), 1).find("did you mean 'leak'"), std::string::npos);
    EXPECT_NE(said(tuning({"--under", "time<2"}), 1).find("lacks a unit"), std::string::npos);
    EXPECT_NE(said(tuning({"--under", "bytes<1B"}), 1).find("keeps bytes<1B: nearest comes shadow_map"), std::string::npos);
    EXPECT_NE(said(tuning({"--validate", "yard.json"}), 1).find("for tuning"), std::string::npos);
    EXPECT_NE(said({"tune", "shadow_map", "yard.json", "--vary", "bais", "-o", "p.json"}, 1).find("bias"), std::string::npos);
    EXPECT_NE(said({"tune", "shadow_map", "yard.json", "-o", "p.txt"}, 1).find("no .json file"), std::string::npos);
    EXPECT_NE(said(tuning({"--budget", "0"}), 2).find("budget"), std::string::npos);
    EXPECT_NE(said({"sweep", "e.json", "--plan"}, 1).find("e.json"), std::string::npos);
    std::ofstream(scratch / "e.json") << R"({"scene": "yard.json", "technique": "shadow_map"})";
    EXPECT_NE(said({"sweep", "e.json", "--plan"}, 1).find("for tuning"), std::string::npos);
}

} // namespace
} // namespace gnomon::tests
