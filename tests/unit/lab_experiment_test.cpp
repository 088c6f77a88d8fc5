// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "lab/sweep.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::lab {
namespace {

namespace fs = std::filesystem;

Experiment read(const std::string& text)
{
    const fs::path file = fs::path(testing::TempDir()) / "gnomon-experiment.json";
    base::write_text(file, text);
    Experiment out = read_experiment(file);
    fs::remove(file);
    return out;
}

const std::string techniques = R"("techniques": [
    {"technique": "shadow_map", "label": "filtered", "params": {"pcf": "$kernel"}},
    {"technique": "ray_traced"}])";

TEST(Experiment, IsTheProductInTheOrderOfTheFile)
{
    const Experiment e
        = read(R"({"scenes": ["plane", {"scene": "balls", "detail": 0.5, "light": "sun"}], "lights": ["sun,elevation=40", "spot"],
        "sizes": ["16x8", "32x16"], "axes": {"kernel": [3, 1]}, )"
            + techniques + "}");
    ASSERT_EQ(e.cells.size(), size_t(2 * 2 * 2 * 2 + 1 * 2 * 2 * 2));
    const auto columns = [&](size_t i) {
        const auto& c = e.cells[i].columns;
        return c.at("scene") + " " + c.at("light") + " " + c.at("size") + " " + c.at("kernel") + " " + c.at("technique");
    };
    EXPECT_EQ(columns(0), "plane sun,elevation=40 16x8 3 filtered");
    EXPECT_EQ(columns(1), "plane sun,elevation=40 16x8 3 ray_traced");
    EXPECT_EQ(columns(2), "plane sun,elevation=40 16x8 1 filtered");
    EXPECT_EQ(columns(4), "plane sun,elevation=40 32x16 3 filtered");
    EXPECT_EQ(columns(8), "plane spot 16x8 3 filtered");
    EXPECT_EQ(columns(16), "balls sun 16x8 3 filtered");
    EXPECT_EQ(e.cells[16].stage.load.detail, 0.5);
    // what the axis does not concern is one run
    EXPECT_EQ(e.cells[1].key, e.cells[3].key);
    EXPECT_EQ(distinct_runs(e).size(), size_t(12 * 2 - 6) + 0u);
}

TEST(Experiment, KeysFollowWhatDeterminesAResult)
{
    const auto key = [](const std::string& more, const std::string& params = "{\"pcf\": 3}", const std::string& scene = "balls") {
        return read(R"({"scene": ")" + scene + R"(", "size": "16x8", "techniques": [{"technique": "shadow_map", "params": )" + params + "}]"
            + more + "}")
            .cells.front()
            .key;
    };
    const std::string same = key("");
    EXPECT_EQ(key(R"(, "title": "other", "metrics": ["mae"], "plots": [{"x": "scene", "y": "mae"}])"), same);
    EXPECT_EQ(key("", R"({"pcf": 3, "map_size": 2048})"), same) << "the default said aloud";
    const std::set<std::string> keys = {same, key("", "{}" /* pcf 3 is the default */), key("", R"({"pcf": 5})"),
        key("", "{\"pcf\": 3}", "contact"), key(R"(, "repeats": 4)"), key(R"(, "warm_up": 4)"), key(R"(, "truth_samples": 4)"),
        key(R"(, "frame": 4)"), key(R"(, "camera": "eye=1/2/3,target=0/0/0")"), key(R"(, "light": "sun,elevation=33")"),
        key(R"(, "metrics": ["flip"])"), key(R"(, "reference": "shadow_map:pcf=9")"), key(R"(, "reference": "shadow_map:pcf=7")")};
    EXPECT_EQ(keys.size(), 12u);
}

TEST(Experiment, AxesFillAnyText)
{
    const Experiment e
        = read(R"({"scene": "balls", "light": {"light": "sun,elevation=$elevation", "label": "at $elevation"}, "size": "16x8",
        "axes": {"kernel": [1, 3], "elevation": [20, 60]}, "reference": {"technique": "shadow_map", "params": {"pcf": "$kernel"}}, )"
            + techniques + "}");
    ASSERT_EQ(e.cells.size(), 8u);
    // cells of one stage follow one another although the axis is not the outermost
    EXPECT_EQ(e.cells[0].stage.lights.front(), "sun,elevation=20");
    EXPECT_EQ(e.cells[3].stage.lights.front(), "sun,elevation=20");
    EXPECT_EQ(e.cells[4].stage.lights.front(), "sun,elevation=60");
    EXPECT_EQ(e.cells[4].columns.at("light"), "at 60");
    EXPECT_EQ(choice_text(*e.cells[0].reference), "shadow_map:pcf=1");
    EXPECT_EQ(choice_text(parse_choice(choice_text(*e.cells[0].reference))), "shadow_map:pcf=1");
}

TEST(Experiment, GroupsAreMeans)
{
    const Experiment e = read(R"({"scene": "balls", "size": "16x8", "axes": {"kernel": [1, 3]}, )" + techniques + "}");
    Results results;
    double ms = 1;
    size_t number = 0;
    for (const Cell* cell : distinct_runs(e)) {
        nlohmann::ordered_json line = {{"format", 1}, {"key", cell->key}, {"device", "d"}, {"driver", "v"}, {"commit", "c"},
            {"technique", cell->choice.info->id}, {"technique_ms", ms}, {"bytes", 2097152},
            {"passes",
                {{{"name", std::string(cell->choice.info->id) + "/resolve"}, {"ms", 10 * ms}},
                    {{"name", std::string(cell->choice.info->id) + "/sum rows"}, {"ms", ms}, {"count", 3}},
                    {{"name", std::string(cell->choice.info->id) + "/sum columns"}, {"ms", 2 * ms}}}},
            {"counts", {{"tile_tests", 100 * number}, {"sample_tests", 1}}}, {"metrics", {{"mae", nullptr}, {"rms", ms}}}};
        results.add(line.dump(), "file", ++number);
        ms *= 2;
    }
    const std::vector<Row> rows = result_rows(e, results);
    ASSERT_EQ(rows.size(), 4u);
    const std::vector<RowGroup> groups = grouped(rows, {"technique"}, {});
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].key.front(), "filtered");
    EXPECT_EQ(groups[0].mean("ms"), (1.0 + 4.0) / 2);
    EXPECT_EQ(groups[1].mean("ms"), 2.0);
    EXPECT_EQ(groups[0].mean("pass:resolve"), 25.0);
    EXPECT_EQ(groups[0].mean("pass:sum*"), 7.5);
    EXPECT_EQ(groups[0].mean("pass:sum rows+resolve"), 27.5);
    EXPECT_FALSE(groups[0].mean("pass:sum"));
    EXPECT_EQ(groups[0].mean("passes"), 5.0);
    EXPECT_EQ(groups[0].mean("count:tile_tests"), 100.0) << "of the first and the third run";
    EXPECT_EQ(groups[0].mean("count:tile_tests+sample_tests+updates"), 101.0);
    EXPECT_FALSE(groups[0].mean("count:updates"));
    EXPECT_EQ(groups[0].mean("mib"), 2.0);
    EXPECT_FALSE(groups[0].mean("mae")) << "what was not finite is none";
    EXPECT_EQ(grouped(rows, {"technique"}, {{"kernel", {"3"}}})[0].mean("ms"), 4.0);
    results.demand_device("d", "v", "file");
    EXPECT_THROW(results.demand_device("d", "w", "file"), base::Error);
    EXPECT_THROW(results.add("{}", "file", 3), base::Error);
}

TEST(Experiment, LinesWithPassesOfAnotherFormAreNoResults)
{
    Results results;
    const auto line = [](const std::string& pass) {
        return R"({"format": 1, "key": "k", "device": "d", "driver": "v", "commit": "c", "technique": "t", "metrics": {}, "passes": [)"
            + pass + "]}";
    };
    results.add(line(R"({"name": "t/resolve", "ms": 1, "count": 2})"), "file", 1);
    for (const char* pass : {R"({"name": 5})", R"({"name": "t/resolve", "count": "two"})", R"({"count": -1})", "3"})
        EXPECT_THROW(results.add(line(pass), "file", 2), base::Error) << pass;
    EXPECT_THROW(results.add(std::string(100000, '['), "file", 3), base::Error);
}

TEST(Experiment, NestingIsRefusedBeforeItIsPrinted)
{
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_THROW(read(R"({"scene": "plane", "techniques": ["shadow_map"], "axes": {"a": [)" + deep + "]}}"), base::Error);
    EXPECT_THROW(read(R"({"scene": {"scene": "plane", "gltf_scene": 1e300}, "techniques": ["shadow_map"]})"), base::Error);
}

TEST(Experiment, TablesTakeHeadingsAndPublishedRows)
{
    const std::string head = R"({"scene": "balls", "size": "16x8", "axes": {"kernel": [1, 3]}, )" + techniques
        + R"(, "tables": [{"rows": ["technique"], "columns": ["mae", {"column": "pass:sum*", "label": "sums"}], "published": [)";
    const Experiment e = read(head + R"({"rows": ["paper"], "values": [null, 2.5]}]}]})");
    const TableSpec& table = e.tables.front();
    EXPECT_EQ(table.columns, (std::vector<std::string>{"mae", "pass:sum*"}));
    EXPECT_EQ(table.labels, (std::vector<std::string>{"mae", "sums"}));
    ASSERT_EQ(table.published.size(), 1u);
    EXPECT_EQ(table.published[0].texts.front(), "paper");
    EXPECT_FALSE(table.published[0].numbers[0]);
    EXPECT_EQ(table.published[0].numbers[1], 2.5);
    EXPECT_THROW(read(head + R"({"rows": ["paper"], "values": [2.5]}]}]})"), base::Error);
    EXPECT_THROW(read(head + R"({"rows": ["paper", "x"], "values": [1, 2.5]}]}]})"), base::Error);
    EXPECT_THROW(read(head + R"({"rows": ["paper"], "values": ["1", 2.5]}]}]})"), base::Error);
}

} // namespace
} // namespace gnomon::lab
