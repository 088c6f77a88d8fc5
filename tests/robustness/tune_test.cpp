// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_scene(const Scratch& scratch)
{
    std::ofstream(scratch / "yard.json")
        << R"({"model": "balls", "tuning": true, "lights": [{"name": "noon", "type": "directional", "direction": [0.4, -1, 0.2]}]})";
    std::ofstream(scratch / "room.json")
        << R"({"model": "contact", "validation": true, "lights": [{"name": "dusk", "type": "directional", "direction": [1, -0.7, 0.2]}]})";
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
    const Finished first = run_gnomon(tuning({"--json"}), scratch.folder());
    ASSERT_EQ(first.code, 0) << first.err;
    const Json preset = Json::parse(read_whole(scratch / "yard.preset.json"));
    EXPECT_EQ(Json::parse(first.out), preset);
    EXPECT_EQ(preset.at("technique"), "shadow_map");
    EXPECT_EQ(preset.at("params").at("map_size"), 128);
    EXPECT_TRUE(preset.at("params").contains("bias_scale"));
    EXPECT_LE(preset.at("tuning").at("ratio"), 1);
    EXPECT_EQ(preset.at("tuning").at("terms").size(), 2u) << "leak + acne, and mae";
    EXPECT_FALSE(preset.contains("validation")) << "none was asked for";
    for (const char* key : {"device", "driver", "commit"}) EXPECT_FALSE(preset.at(key).get<std::string>().empty());

    const Finished again = run_gnomon(tuning({}), scratch.folder());
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

TEST(Tune, KeepsWhatGainsInValidationAndWritesNothingElse)
{
    const Scratch scratch;
    write_scene(scratch);
    // without any bias, both scenes are full of acne
    const std::vector<std::string> bare = {"tune", "shadow_map:map_size=128:bias=constant", "yard.json", "--vary", "bias_constant",
        "--size", "64x40", "--budget", "12", "--validate", "room.json", "-o", "bare.json"};
    const Finished kept = run_gnomon(bare, scratch.folder());
    ASSERT_EQ(kept.code, 0) << kept.out << kept.err;
    const Json preset = Json::parse(read_whole(scratch / "bare.json"));
    EXPECT_GT(preset.at("params").at("bias_constant"), 0);
    EXPECT_EQ(preset.at("validation").at("places").size(), 1u);
    EXPECT_LT(preset.at("validation").at("ratio"), 1);

    // which triangles are drawn changes no picture
    const Finished nothing = run_gnomon({"tune", "shadow_map:map_size=128", "yard.json", "--vary", "culling", "--size", "64x40", "--budget",
                                            "4", "--validate", "room.json", "-o", "none.json"},
        scratch.folder());
    EXPECT_EQ(nothing.code, 1) << nothing.out << nothing.err;
    EXPECT_NE(nothing.out.find("no preset was written"), std::string::npos) << nothing.out;
    EXPECT_FALSE(fs::exists(scratch / "none.json"));
}

TEST(Tune, GoesOnWhereItWasKilled)
{
    const Scratch scratch;
    write_scene(scratch);
    std::vector<std::string> call = tuning({});
    *std::find(call.begin(), call.end(), "6") = "40";
    const fs::path runs = scratch / "yard.preset.runs.jsonl";
    RunOptions killing;
    killing.kill_when = [&] { return fs::exists(runs) && read_whole(runs).find("bias_scale") != std::string::npos; };
    const Finished killed = run_gnomon(call, scratch.folder(), killing);
    ASSERT_EQ(killed.signal, 9) << killed.out << killed.err;
    const std::string before = read_whole(runs);
    // half a line, as of a process that died while writing
    std::ofstream(runs, std::ios::app) << "{\"key\": \"12";
    const Finished on = run_gnomon(call, scratch.folder());
    ASSERT_EQ(on.code, 0) << on.err;
    const std::string after = read_whole(runs);
    EXPECT_EQ(after.substr(0, before.rfind('\n') + 1), before.substr(0, before.rfind('\n') + 1)) << "what was measured stays";
    EXPECT_EQ(on.out.find(", 0 kept from before"), std::string::npos) << on.out;
}

TEST(Tune, SaysWhatIsWrongWithItsFiles)
{
    const Scratch scratch;
    write_scene(scratch);
    for (const char* line : {"not json", "[]", R"({"key": 3, "values": {}, "reference": {}})",
             R"({"key": "ab", "values": [1], "reference": {}})", R"({"key": "ab", "values": {"leak": "much"}, "reference": {}})"}) {
        std::ofstream(scratch / "yard.preset.runs.jsonl") << line << "\n";
        expect_sentence(run_gnomon(tuning({}), scratch.folder()), 1, {"yard.preset.runs.jsonl", "no measurement of this search"});
    }
    fs::remove(scratch / "yard.preset.runs.jsonl");
    fs::create_directory(scratch / "yard.preset.runs.jsonl");
    expect_sentence(run_gnomon(tuning({}), scratch.folder()), 1, {"yard.preset.runs.jsonl"});
    fs::remove(scratch / "yard.preset.runs.jsonl");
    fs::create_symlink("/dev/full", scratch / "yard.preset.runs.jsonl");
    expect_sentence(run_gnomon(tuning({}), scratch.folder()), 1, {"yard.preset.runs.jsonl"});
    fs::remove(scratch / "yard.preset.runs.jsonl");
    // a folder where the preset is to be
    fs::create_directory(scratch / "yard.preset.json");
    expect_sentence(run_gnomon(tuning({}), scratch.folder()), 1, {"yard.preset.json"});
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
    EXPECT_NE(said(tuning({"--validate", "contact"}), 1).find("of published tables"), std::string::npos);
    EXPECT_NE(said(tuning({"--minimise", "leak,"}), 1).find("unknown metric"), std::string::npos);
    EXPECT_NE(said(tuning({"--camera", "attic"}), 1).find("attic"), std::string::npos);
    EXPECT_NE(said(tuning({"--under", "leak<0.0000001x"}), 1).find("keeps leak<0.0000001x"), std::string::npos);
    EXPECT_NE(said({"tune", "shadow_map", "yard.json", "--vary", "bais", "-o", "p.json"}, 1).find("bias"), std::string::npos);
    EXPECT_NE(said({"tune", "shadow_map", "yard.json", "-o", "p.txt"}, 1).find("no .json file"), std::string::npos);
    EXPECT_NE(said(tuning({"--budget", "0"}), 2).find("budget"), std::string::npos);
    EXPECT_NE(said({"sweep", "e.json", "--plan"}, 1).find("e.json"), std::string::npos);
    std::ofstream(scratch / "e.json") << R"({"scene": "yard.json", "technique": "shadow_map"})";
    EXPECT_NE(said({"sweep", "e.json", "--plan"}, 1).find("for tuning"), std::string::npos);
    std::ofstream(scratch / "e.json") << R"({"scene": "room.json", "technique": "shadow_map"})";
    EXPECT_NE(said({"sweep", "e.json", "--plan"}, 1).find("for validation"), std::string::npos);
}

} // namespace
} // namespace gnomon::tests
