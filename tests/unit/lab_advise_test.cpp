// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include "base/error.h"
#include "lab/halving.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gnomon::lab {
namespace {

Stage stage_of(const std::string& scene, const std::string& light, StageOptions* options = nullptr)
{
    StageOptions o{.scene = scene, .lights = {light}, .size = {320, 180}};
    if (options) *options = o;
    return open_stage(o);
}

Features features_of(const std::string& scene, const std::string& light)
{
    StageOptions options;
    const Stage stage = stage_of(scene, light, &options);
    return find_features(stage, options);
}

TEST(Features, TellMaterialsAndOpenMeshes)
{
    const Features tree = features_of("tree", "sun,elevation=50,angle=0");
    EXPECT_GT(tree.masked, 0u);
    EXPECT_EQ(tree.see_through, 0u);
    EXPECT_EQ(tree.triangles, 35116u);
    EXPECT_GT(features_of("stacked_panes", "sun,elevation=50,angle=0").see_through, 0u);
    const Features balls = features_of("balls", "sun,elevation=50,angle=0");
    EXPECT_EQ(balls.masked + balls.see_through, 0u);
    EXPECT_LT(balls.open_meshes, balls.meshes);
    EXPECT_FALSE(balls.soft);
    EXPECT_EQ(balls.penumbra_pixels, 0);
    EXPECT_GT(balls.shadowed, 0.02);
    EXPECT_FALSE(balls.moves);
    EXPECT_EQ(features_of("closed_box", "sun,elevation=50,angle=0").shadowed, 1);
}

TEST(Features, EstimateWiderPenumbraeForWiderLights)
{
    const Features narrow = features_of("balls", "sun,elevation=50,angle=0.5"), wide = features_of("balls", "sun,elevation=50,angle=10");
    EXPECT_TRUE(narrow.soft);
    EXPECT_GT(wide.penumbra_pixels, 3 * narrow.penumbra_pixels);
    // half a metre above the floor, 10 degrees leave 15 cm, of which a metre has some 29 pixels; most is nearer to its shadow
    EXPECT_GT(wide.penumbra_pixels, 1);
    EXPECT_LT(wide.penumbra_pixels, 10);
}

TEST(Features, KnowAnOpenMesh)
{
    scene::Mesh tetrahedron;
    tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    EXPECT_FALSE(is_open(tetrahedron));
    // corners of their own for each triangle close it all the same
    scene::Mesh split = tetrahedron;
    split.positions.clear();
    for (uint32_t& i : split.indices) {
        split.positions.push_back(tetrahedron.positions[i]);
        i = uint32_t(split.positions.size() - 1);
    }
    EXPECT_FALSE(is_open(split));
    tetrahedron.indices.resize(9);
    EXPECT_TRUE(is_open(tetrahedron));
}

TEST(Candidates, FollowFromWhatParametersAreCalled)
{
    const Stage sun = stage_of("plane", "sun,elevation=50,angle=0"), point = stage_of("plane", "point,position=0/3/0,radius=0");
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        const std::vector<Choice> all = settings(*info, sun.lights.front(), Prefer::any);
        ASSERT_FALSE(all.empty()) << info->id;
        EXPECT_LE(all.size(), 20u) << info->id;
        std::set<std::string> texts;
        for (const Choice& c : all) EXPECT_TRUE(texts.insert(choice_text(c)).second) << choice_text(c);
        EXPECT_TRUE(texts.count(std::string(info->id))) << "the defaults of " << info->id << " are missing";
        const shadow::ParamTable table = info->params();
        const shadow::ParamInfo* size = table.find("map_size");
        if (size && size->type == shadow::ParamType::integer) {
            EXPECT_GE(all.size(), 3u) << info->id;
        }
        for (const Choice& c : settings(*info, point.lights.front(), Prefer::any))
            EXPECT_EQ(choice_text(c).find("sdsm"), std::string::npos) << "sdsm is for suns";
        for (const Choice& c : settings(*info, sun.lights.front(), Prefer::stable)) {
            const shadow::ParamInfo *fit = c.params.table().find("fit"), *stable = c.params.table().find("stable_cascades");
            if (!fit || !stable) continue;
            const std::string text = c.params.text(*fit);
            EXPECT_TRUE(text == "uniform" || (text == "cascades" && c.params.get(*stable) == 1)) << choice_text(c);
        }
    }
}

TEST(Candidates, LetLightThroughWhereCastersDo)
{
    const Stage sun = stage_of("plane", "sun,elevation=50,angle=0");
    const auto count = [&](const shadow::TechniqueInfo& info, bool see_through) {
        const std::vector<Choice> all = settings(info, sun.lights.front(), Prefer::any, see_through);
        return std::count_if(all.begin(), all.end(), [](const Choice& c) { return output_of(c) == shadow::Output::transmittance; });
    };
    long found = 0;
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        if (!info->output_of || info->output == shadow::Output::transmittance) continue;
        EXPECT_EQ(count(*info, false), 0) << info->id;
        found += count(*info, true);
    }
    EXPECT_GT(found, 0);
}

TEST(Candidates, CostMoreWithMoreOfTheSame)
{
    EXPECT_TRUE(costs_more(parse_choice("pcf:map_size=2048"), parse_choice("pcf")));
    EXPECT_TRUE(costs_more(parse_choice("pcf:map_size=2048:taps=64"), parse_choice("pcf")));
    EXPECT_FALSE(costs_more(parse_choice("pcf"), parse_choice("pcf")));
    EXPECT_FALSE(costs_more(parse_choice("pcf"), parse_choice("pcf:map_size=2048")));
    EXPECT_FALSE(costs_more(parse_choice("pcf:map_size=2048:taps=8"), parse_choice("pcf")));
    EXPECT_TRUE(costs_more(parse_choice("pcf:map_size=2048:fit=sdsm"), parse_choice("pcf")));
    EXPECT_TRUE(costs_more(parse_choice("pcf:fit=cascades"), parse_choice("pcf")));
    EXPECT_FALSE(costs_more(parse_choice("pcf:map_size=512:fit=cascades"), parse_choice("pcf")));
    EXPECT_FALSE(costs_more(parse_choice("pcf:fit=sdsm"), parse_choice("pcf:fit=cascades")));
    EXPECT_FALSE(costs_more(parse_choice("pcf:fit=focused"), parse_choice("pcf")));
    EXPECT_FALSE(costs_more(parse_choice("pcf:map_size=2048"), parse_choice("shadow_map")));
}

TEST(Candidates, PreferencesHaveNames)
{
    EXPECT_EQ(parse_prefer("stable"), Prefer::stable);
    EXPECT_THROW(parse_prefer("stabel"), base::Error);
}

/// An advice with these measurements, the first of which is the choice.
Advice advice_of(std::vector<Measured> measured)
{
    Advice a;
    a.metric = "mae", a.reference = "shadow_map", a.reference_ms = 3, a.budget = {"2x"}, a.size = {64, 36};
    a.candidates = 40, a.techniques = 4, a.measured = std::move(measured);
    a.features.triangles = 100, a.features.meshes = 1;
    if (a.measured.front().excess == 0) a.chosen = a.measured.front();
    return a;
}

Measured measured(const std::string& choice, double error, double ms, double excess = 0)
{
    return {parse_choice(choice), {.error = error, .ms = ms, .mean_ms = ms, .bytes = 1 << 20}, excess};
}

bool holds(const Advice& a, const std::string& sentence)
{
    const std::vector<std::string> all = advice_reasons(a);
    return std::find(all.begin(), all.end(), sentence) != all.end();
}

TEST(Reasons, NameTheBudgetTheChoiceAndWhatStandsBeside)
{
    const Advice a = advice_of({measured("pcf", 0.02, 4), measured("pcf:taps=64", 0.03, 5), measured("vsm", 0.025, 5),
        measured("msm", 0.01, 9, 0.5), measured("evsm", 0.005, 30, 4)});
    EXPECT_TRUE(holds(a, "the budget of 2x is 6 ms here: shadow_map takes 3 ms"));
    EXPECT_TRUE(holds(a, "pcf errs least of those within 2x: mae 0.02 in 4 ms and 1 MiB"));
    EXPECT_TRUE(holds(a, "the next technique is vsm: mae 0.025 in 5 ms and 1 MiB"));
    EXPECT_TRUE(holds(a, "with more to spend there is msm: mae 0.01 in 9 ms and 1 MiB")) << "the nearest beyond the budget, not the best";
    EXPECT_TRUE(holds(a, "40 settings of 4 techniques fit; small pictures left 5 to measure at the full 64x36"));
}

TEST(Reasons, NameWhatTheChoiceLacks)
{
    Advice soft = advice_of({measured("pcf", 0.02, 4)});
    soft.features.soft = true;
    EXPECT_TRUE(holds(soft, "it takes the light as a point, and yet nothing with penumbrae that keeps the budget errs less"));
    Advice panes = advice_of({measured("pcf", 0.02, 4), measured("shadow_volumes:log_alpha=on", 0.01, 9, 0.5)});
    panes.features.see_through = 10;
    EXPECT_TRUE(holds(panes,
        "it lets no light through semitransparent casters, which is a part of its error; of those that do, shadow_volumes:log_alpha=on "
        "errs "
        "least: mae 0.01 in 9 ms and 1 MiB, over the budget"));
    Advice glass = advice_of({measured("shadow_volumes:log_alpha=on", 0.01, 9)});
    glass.features.see_through = 10;
    for (const std::string& reason : advice_reasons(glass)) EXPECT_EQ(reason.find("it lets no light"), std::string::npos) << reason;
    EXPECT_TRUE(holds(glass, "its method is exact: only pixels on shadows' edges may differ"));
}

TEST(Reasons, NameTheNearestWhereNothingKeepsTheBudget)
{
    const Advice a = advice_of({measured("vsm", 0.01, 60, 9), measured("pcf", 0.02, 9, 0.5)});
    EXPECT_FALSE(a.chosen);
    EXPECT_EQ(nothing_keeps(a),
        "nothing that fits keeps the budget of 2x (shadow_map takes 3 ms): nearest comes pcf with mae 0.02 in 9 ms and 1 MiB; allow that, "
        "or "
        "take a smaller picture");
    EXPECT_FALSE(advice_reasons(a).empty());
}

TEST(Halving, FrontHoldsWhatNothingBeats)
{
    const std::vector<Trial> trials = {{5, 1}, {4, 2}, {4, 3}, {1, 9}, {2, 4}, {6, 1}, {1, 10}};
    EXPECT_EQ(pareto_front(trials), (std::vector<size_t>{0, 1, 4, 3}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Halving, MeasuresFewDearlyAndKeepsTheBest)
{
    constexpr size_t count = 64;
    std::vector<size_t> made(3, 0);
    const auto measure = [&](size_t i, int round) {
        ++made[size_t(round)];
        // small pictures blur the order of neighbours; 37 is the best
        const double noise = round == 2 ? 0 : 0.01 * double((i * 7) % 5);
        return std::optional(Trial{0.05 * std::abs(double(i) - 37) + noise, 1 + 0.001 * double(i), 0});
    };
    const std::vector<size_t> last = halve({.candidates = count, .measure = measure});
    EXPECT_NE(std::find(last.begin(), last.end(), 37u), last.end());
    EXPECT_EQ(made, (std::vector<size_t>{64, 22, 8}));
    EXPECT_EQ(last.size(), 8u);
    EXPECT_TRUE(std::is_sorted(last.begin(), last.end()));
}

TEST(Halving, DropsWhatIsOverTheBudgetAndWhatCannotRun)
{
    const auto measure = [](size_t i, int) -> std::optional<Trial> {
        if (i == 0) return {};
        const double time = double(i);
        return Trial{1.0 / time, time, time > 10 ? time / 10 - 1 : 0.0};
    };
    const std::vector<size_t> last = halve({.candidates = 40, .measure = measure});
    EXPECT_NE(std::find(last.begin(), last.end(), 10u), last.end()) << "the best within";
    for (const size_t i : last) {
        EXPECT_LE(i, 20u) << "far over the budget";
        EXPECT_NE(i, 0u);
    }
}

TEST(Halving, GoesOnWithTheNearestWhereNothingIsWithin)
{
    const auto measure = [](size_t i, int) { return std::optional(Trial{1, 1, 5.0 + double(i)}); };
    const std::vector<size_t> last = halve({.candidates = 32, .measure = measure});
    EXPECT_EQ(last.front(), 0u);
    EXPECT_EQ(last.size(), 8u);
    EXPECT_TRUE(halve({.candidates = 0, .measure = measure}).empty());
}

} // namespace
} // namespace gnomon::lab
