// SPDX-License-Identifier: Apache-2.0
// The page of a comparison: whole in one file, and what it says is what was measured.
#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace gnomon::tests {
namespace {

using Json = nlohmann::json;

std::string between(const std::string& text, const std::string& begin, const std::string& end)
{
    const size_t from = text.find(begin);
    if (from == std::string::npos) return {};
    const size_t to = text.find(end, from + begin.size());
    return text.substr(from + begin.size(), to - from - begin.size());
}

TEST(Report, PageHoldsAllThatItShows)
{
    Scratch scratch;
    const Finished run = run_gnomon({"compare", "plane", "--techniques", "shadow_map,shadow_map:bias_scale=2,pcss,ray_traced", "--light",
                                        "sun,elevation=50,name=a</script>b", "--light", "point,position=0/3/0,radius=0.1", "--size",
                                        "32x24", "--repeats", "1", "-o", "c"},
        scratch.folder());
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string page = read_whole(scratch / "c/index.html");
    const Json data = Json::parse(between(page, "<script type=\"application/json\" id=\"data\">", "</script>"));
    const Json results = Json::parse(read_whole(scratch / "c/results.json"));
    ASSERT_EQ(data.at("runs").size(), 8u);
    std::set<std::string> names;
    for (size_t i = 0; i < 8; ++i) {
        const Json& shown = data.at("runs")[i];
        EXPECT_EQ(shown.at("metrics"), results.at("runs")[i].at("metrics"));
        names.insert(shown.at("name").get<std::string>());
        for (const char* kind : {"lit", "visibility", "error"}) {
            const std::string file = shown.at("pictures").at(kind);
            const std::string png = data.at("pictures").at(file);
            EXPECT_EQ(png.substr(0, 11), "iVBORw0KGgo") << "a PNG in base 64";
            EXPECT_EQ(png.size(), (read_whole(scratch / ("c/" + file)).size() + 2) / 3 * 4) << file;
        }
        for (const char* key : {"title", "family", "cite"}) EXPECT_FALSE(shown.at(key).get<std::string>().empty()) << key;
        size_t judges = 0;
        for (const Json& t : data.at("truths")) judges += t.at("light") == shown.at("light") && t.at("quantity") == shown.at("quantity");
        EXPECT_EQ(judges, 1u);
    }
    EXPECT_EQ(names, (std::set<std::string>{"shadow_map", "shadow_map:bias_scale=2", "pcss", "ray_traced"}));
    // under each light the front is what no other beats in both
    for (const Json& a : data.at("runs")) {
        bool beaten = false;
        for (const Json& b : data.at("runs")) {
            const double ms = a.at("technique_ms").get<double>() - b.at("technique_ms").get<double>();
            const double mae = a.at("metrics").at("mae").get<double>() - b.at("metrics").at("mae").get<double>();
            beaten = beaten || (a.at("light") == b.at("light") && ms >= 0 && mae >= 0 && (ms > 0 || mae > 0));
        }
        EXPECT_EQ(a.value("front", false), !beaten) << a.at("name");
    }
    for (const Json& metric : data.at("metrics")) {
        EXPECT_FALSE(metric.at("unit").get<std::string>().empty()) << metric;
        EXPECT_FALSE(metric.at("help").get<std::string>().empty()) << metric;
    }
    for (const char* place : {"@REPORT_DATA@", "@REPORT_SCRIPT@"}) EXPECT_EQ(page.find(place), std::string::npos) << place;
    for (const char* elsewhere : {"src=\"http", "href=\"http", "url(http", "@import", "fetch("})
        EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
    if (data.contains("no_plot"))
        EXPECT_NE(data.at("no_plot").get<std::string>().find("gnuplot"), std::string::npos);
    else
        EXPECT_EQ(data.at("plots").size(), 2u) << "one a light";
    const std::string csv = read_whole(scratch / "c/results.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 9);
}

} // namespace
} // namespace gnomon::tests
