// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "lab/quality.h"
#include "tests/source_root.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon {

namespace {

using namespace shadow;

std::vector<const Quality*> entries_of(scene::LightKind kind, bool area, Level level)
{
    std::vector<const Quality*> out;
    for (const Quality& q : qualities().entries)
        if (q.light == kind && q.area == area && q.level == level) out.push_back(&q);
    return out;
}

/// Walks the kinds of light, with and without an area: rectangles and disks have one.
template <class F> void for_lights(F body)
{
    for (int k = 0; k < scene::light_kind_count; ++k)
        for (const bool area : {false, true}) {
            const auto kind = scene::LightKind(k);
            if (!area && (kind == scene::LightKind::rect || kind == scene::LightKind::disk)) continue;
            SCOPED_TRACE(std::string(scene::kind_name(kind)) + (area ? ", area" : ", hard"));
            body(kind, area);
        }
}

TEST(Quality, every_light_has_every_level_of_a_technique_that_suits_it)
{
    for_lights([](scene::LightKind kind, bool area) {
        for (int level = 0; level < level_count; ++level) {
            const auto entries = entries_of(kind, area, Level(level));
            ASSERT_FALSE(entries.empty()) << level_name(Level(level));
            for (const Quality* q : entries) {
                EXPECT_TRUE(q->technique->lights & light_bit(kind)) << q->technique->id;
                EXPECT_FALSE(q->technique->partial || q->technique->temporal) << q->technique->id;
                EXPECT_EQ(q->technique->soft, area) << q->technique->id;
                EXPECT_EQ(output(*q->technique, q->params.bytes()), Output::visibility);
            }
        }
        const Quality& exact = *entries_of(kind, area, Level::exact).front();
        EXPECT_TRUE(exact.technique->exact) << exact.technique->id;
    });
}

TEST(Quality, each_level_costs_more_and_errs_less_as_measured)
{
    for_lights([](scene::LightKind kind, bool area) {
        for (int level = 1; level < level_count; ++level) {
            const Quality& less = *entries_of(kind, area, Level(level - 1)).front();
            for (const Quality* more : entries_of(kind, area, Level(level))) {
                SCOPED_TRACE(std::string(level_name(more->level)) + " " + std::string(more->technique->id));
                ASSERT_TRUE(less.price && more->price);
                EXPECT_GT(more->price->time, less.price->time);
                EXPECT_LT(more->price->mae, less.price->mae);
                EXPECT_LE(more->price->least_time, more->price->time);
                EXPECT_GE(more->price->most_time, more->price->time);
                EXPECT_EQ(more->price->wrong_pixels.has_value(), !area);
                EXPECT_TRUE(area || *more->price->wrong_pixels < *less.price->wrong_pixels);
            }
        }
    });
}

TEST(Quality, prices_are_those_of_the_committed_results)
{
    EXPECT_EQ(lab::priced_qualities(tests::source_root()), base::read_text(tests::source_root() / "src" / "shadow" / "quality.json"))
        << "run `gnomon docs`";
    EXPECT_NE(lab::qualities_text().find(qualities().measured), std::string::npos);
    EXPECT_EQ(lab::qualities_json()["entries"].size(), qualities().entries.size());
}

std::string parse_error(const std::string& entry)
{
    try {
        parse_qualities(R"({"measured": "", "baseline": "", "entries": [)" + entry + "]}");
    } catch (const base::Error& e) {
        return e.what();
    }
    return "";
}

TEST(Quality, a_wrong_table_is_a_sentence)
{
    EXPECT_EQ(parse_error(R"({"light": "rect", "area": true, "level": "low", "technique": "pcss", "params": {"map_size": 64}})"), "");
    EXPECT_NE(
        parse_error(R"({"light": "rect", "area": true, "level": "low", "technique": "pcf"})").find("does not take"), std::string::npos);
    EXPECT_NE(parse_error(R"({"light": "moon", "area": true, "level": "low", "technique": "pcf"})").find("'moon'"), std::string::npos);
    EXPECT_NE(parse_error(R"({"light": "rect", "area": true, "level": "lowest", "technique": "pcss"})").find("'low'"), std::string::npos);
    EXPECT_NE(
        parse_error(R"({"light": "rect", "area": true, "level": "low", "technique": "pcss", "params": {"map_size": 1}})").find("map_size"),
        std::string::npos);
    EXPECT_NE(parse_error(R"({"light": "rect"})").find("quality.json cannot be read"), std::string::npos);
    EXPECT_THROW(parse_qualities("{"), base::Error);
}

} // namespace

} // namespace gnomon
