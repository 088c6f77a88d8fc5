// SPDX-License-Identifier: Apache-2.0
#include "lab/goal.h"

#include "base/error.h"
#include "base/file.h"
#include "lab/preset.h"
#include "lab/tune.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;

std::string complaint(const std::function<void()>& about)
{
    try {
        about();
    } catch (const base::Error& e) {
        return e.what();
    }
    return "no complaint";
}

TEST(Goal, ReadsConstraintsWithTheirUnits)
{
    const Constraint twice = parse_constraint("time<2x");
    EXPECT_EQ(twice.quantity, "time");
    EXPECT_TRUE(twice.relative);
    EXPECT_EQ(twice.limit, 2);
    EXPECT_EQ(parse_constraint("time<4ms").limit, 4);
    EXPECT_EQ(parse_constraint("time<0.5s").limit, 500);
    EXPECT_EQ(parse_constraint("bytes<64MiB").limit, 64.0 * 1024 * 1024);
    EXPECT_EQ(parse_constraint("leak<0.001").limit, 0.001);
    EXPECT_FALSE(parse_constraint("leak<0.001").relative);
    EXPECT_TRUE(parse_constraint("mae<0.5x").relative);
    EXPECT_EQ(parse_budget("4ms").quantity, "time");
    EXPECT_EQ(parse_budget("2x").quantity, "time");
    EXPECT_TRUE(parse_budget("2x").relative);
    EXPECT_EQ(parse_budget("1GiB").limit, 1073741824.0);
}

TEST(Goal, RefusesConstraintsInASentence)
{
    struct Bad {
        std::string text, says;
    };
    for (const Bad& bad : std::vector<Bad>{
             {"time", "is no constraint"},
             {"tiem<2x", "did you mean 'time'"},
             {"time<2", "lacks a unit"},
             {"time<", "needs a number"},
             {"time<-2x", "needs a number"},
             {"time<nanx", "needs a number"},
             {"time<2 x", "unknown unit ' x'"},
             {"time<2MiB", "time is not measured in MiB"},
             {"leak<2ms", "leak is not measured in ms"},
             {"bytes<64MB", "unknown unit 'MB'"},
             {"", "is no constraint"},
         })
        EXPECT_NE(complaint([&] { parse_constraint(bad.text); }).find(bad.says), std::string::npos)
            << bad.text << ": " << complaint([&] { parse_constraint(bad.text); });
    EXPECT_NE(complaint([] { parse_budget("4"); }).find("lacks a unit"), std::string::npos);
    EXPECT_NE(complaint([] { parse_budget("cheap"); }).find("needs a number"), std::string::npos);
    EXPECT_NE(complaint([] { parse_sum("leak+akne"); }).find("did you mean 'acne'"), std::string::npos);
    EXPECT_NE(complaint([] { parse_sum(""); }).find("unknown metric"), std::string::npos);
    EXPECT_EQ(parse_sum("leak+acne"), (std::vector<std::string>{"leak", "acne"}));
    EXPECT_EQ(parse_terms("leak+acne,mae"), (std::vector<std::vector<std::string>>{{"leak", "acne"}, {"mae"}}));
    EXPECT_NE(complaint([] { parse_terms("leak,"); }).find("unknown metric"), std::string::npos);
    EXPECT_NE(complaint([] { parse_terms("leak,mea"); }).find("did you mean 'mae'"), std::string::npos);
}

TEST(Goal, TakesQuantitiesFromRuns)
{
    lab::Run run;
    run.technique_ms = 3, run.bytes = 1000, run.metrics = {{"leak", 0.25}, {"bias", -0.5}};
    EXPECT_EQ(quantity_of(run, "time"), 3);
    EXPECT_EQ(quantity_of(run, "bytes"), 1000);
    EXPECT_EQ(quantity_of(run, "leak"), 0.25);
    EXPECT_EQ(quantity_of(run, "bias"), 0.5) << "an error's size is what is to be small";
    EXPECT_NE(complaint([&] { quantity_of(run, "filter_mae"); }).find("--reference"), std::string::npos);
    EXPECT_NE(complaint([&] { quantity_of(run, "contact_gap"); }).find("is not measured under the light"), std::string::npos);
    EXPECT_EQ(missed_by(2, 2), 0);
    EXPECT_EQ(missed_by(3, 2), 0.5);
    EXPECT_GT(missed_by(3, 0), 0);
}

class PresetFile : public testing::Test {
protected:
    const fs::path file_ = fs::path(testing::TempDir()) / "gnomon-preset.json";
    void TearDown() override { fs::remove(file_); }
    std::string at() const { return "@" + file_.string(); }
};

TEST_F(PresetFile, IsTakenWhereverATechniqueIsNamed)
{
    Preset preset{.choice = parse_choice("shadow_map:bias=slope:map_size=512"), .vary = {"bias", "bias_scale"}, .minimise = "leak+acne"};
    preset.tuning = {{"a", "c", "sun", {4, 4}, {{"leak", 0.4}}, {{"leak", 0.2}}, {0.5, 1}, 0},
        {"b", "c", "sun", {4, 4}, {{"leak", 0.2}}, {{"leak", 0.1}}, {0.25, 0.75}, 0}};
    write_preset(file_, preset);
    EXPECT_EQ(choice_text(parse_choice(at())), "shadow_map:map_size=512:bias=slope");
    EXPECT_EQ(choice_text(parse_choice(at() + ":map_size=256:pcf=5")), "shadow_map:map_size=256:pcf=5:bias=slope");
    const auto json = nlohmann::ordered_json::parse(base::read_text(file_));
    EXPECT_EQ(json["params"].dump(), R"({"map_size":512,"bias":"slope","bias_scale":1.0})");
    EXPECT_NEAR(json["tuning"]["before"]["leak"].get<double>(), 0.3, 1e-12);
    EXPECT_NEAR(json["tuning"]["after"]["leak"].get<double>(), 0.15, 1e-12);
    EXPECT_NEAR(json["tuning"]["ratio"].get<double>(), 0.625, 1e-12);
    EXPECT_NEAR(json["tuning"]["terms"][0].get<double>(), 0.375, 1e-12);
    // deviation of 0.75 and 0.5 from their mean, over the root of two
    EXPECT_NEAR(json["tuning"]["standard_error"].get<double>(), 0.125, 1e-12);
}

TEST(Ratios, GainOnlyBeyondTheirErrorAndWithoutAWorseTerm)
{
    const auto gained = [](std::vector<std::vector<double>> terms) {
        std::vector<Preset::Place> places;
        for (std::vector<double>& t : terms) (places.emplace_back(), places.back().ratios = std::move(t));
        return ratios(places).gained();
    };
    EXPECT_TRUE(gained({{0.9, 0.8}, {0.85, 0.95}}));
    EXPECT_FALSE(gained({{0.5, 0.5}, {1.45, 1.45}})) << "less than its standard error";
    EXPECT_FALSE(gained({{0.5, 1.1}, {0.5, 1.1}})) << "the second term is worse";
    EXPECT_TRUE(gained({{0.9, 1.009}, {0.9, 1.009}})) << "worse by less than a percent";
    EXPECT_FALSE(gained({{0.996, 1}, {0.996, 1}})) << "less than half a percent";
    EXPECT_FALSE(gained({{1, 1}, {1, 1}}));
    EXPECT_FALSE(gained({}));
}

TEST_F(PresetFile, SaysWhatIsWrongWithItAndWhere)
{
    for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
             {"{", "parse error"},
             {"[]", "an object with the keys"},
             {R"({"technique": "shadow_map"})", "\"format\" is not 1"},
             {R"({"format": 1})", "technique"},
             {R"({"format": 1, "technique": "shadow_mop"})", "did you mean 'shadow_map'"},
             {R"({"format": 1, "technique": 3})", "type must be string"},
             {R"({"format": 1, "technique": "shadow_map", "params": {"bias_scael": 1}})", "did you mean 'bias_scale'"},
             {R"({"format": 1, "technique": "shadow_map", "params": {"bias_scale": 65}})", "takes 0 to 64"},
             {R"({"format": 1, "technique": "shadow_map", "parms": {}})", "did you mean 'params'"},
         }) {
        base::write_text(file_, text);
        const std::string said = complaint([&] { parse_choice(at()); });
        EXPECT_NE(said.find(says), std::string::npos) << said;
        EXPECT_NE(said.find(file_.string()), std::string::npos) << said;
    }
    EXPECT_NE(complaint([] { parse_choice("@no/such/preset.json"); }).find("no/such/preset.json"), std::string::npos);
}

TEST(Tune, HoldsWhatTheTextSets)
{
    EXPECT_EQ(set_names("pcf:kernel=5:bias=cone"), (std::vector<std::string>{"kernel", "bias"}));
    EXPECT_TRUE(set_names("pcf").empty());
}

} // namespace
} // namespace gnomon::lab
