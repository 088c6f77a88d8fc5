// SPDX-License-Identifier: Apache-2.0
#include "lab/plot_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::lab {
namespace {

constexpr double width = 880, height = 520;

std::vector<PlotMark> crowd(size_t count, double spread)
{
    std::mt19937 random(3);
    std::normal_distribution<double> place(0, spread);
    std::vector<PlotMark> out;
    for (size_t i = 0; i < count; ++i)
        out.push_back({std::clamp(440 + place(random), 0.0, width), std::clamp(260 + place(random), 0.0, height),
            "technique:value=" + std::to_string(i)});
    return out;
}

/// A letter of the plot's font is narrower than this.
bool meet(const LabelPlace& a, const std::string& text, double x, double y, double w, double h)
{
    return a.x < x + w && x < a.x + 6.5 * double(text.size()) && std::abs(a.y - y) < 6 + h / 2;
}

TEST(PlotLabels, AloneATextStandsRightOfItsMark)
{
    const auto places = place_labels({{100, 100, "pcf"}}, {}, width, height);
    ASSERT_TRUE(places[0]);
    EXPECT_GT(places[0]->x, 100);
    EXPECT_LT(places[0]->x, 115);
    EXPECT_DOUBLE_EQ(places[0]->y, 100);
    EXPECT_FALSE(places[0]->line);
}

TEST(PlotLabels, SixtyInAHeapCoverNeitherEachOtherNorMarks)
{
    const std::vector<PlotMark> marks = crowd(60, 110);
    const auto places = place_labels(marks, {}, width, height);
    size_t placed = 0;
    for (size_t i = 0; i < marks.size(); ++i) {
        if (!places[i]) continue;
        ++placed;
        EXPECT_GE(places[i]->x, 0);
        EXPECT_LE(places[i]->x + 6.5 * double(marks[i].text.size()), width);
        for (size_t j = 0; j < marks.size(); ++j) {
            EXPECT_FALSE(meet(*places[i], marks[i].text, marks[j].x - 3, marks[j].y, 6, 6)) << i << " on the mark " << j;
            if (j <= i || !places[j]) continue;
            const double other = 6.5 * double(marks[j].text.size());
            EXPECT_FALSE(meet(*places[i], marks[i].text, places[j]->x, places[j]->y, other, 12)) << i << " on " << j;
        }
    }
    EXPECT_GE(placed, 54u);
}

TEST(PlotLabels, ATextKeepsOffALineAndGoesLeftAtTheRightEdge)
{
    const auto struck = place_labels({{100, 100, "virtual_shadow_map"}}, {{100, 100, 400, 100}}, width, height);
    ASSERT_TRUE(struck[0]);
    EXPECT_TRUE(struck[0]->x + 6.5 * 18 < 108 || std::abs(struck[0]->y - 100) >= 6);
    const auto edge = place_labels({{width - 4, 100, "pcf"}}, {}, width, height);
    ASSERT_TRUE(edge[0]);
    EXPECT_LT(edge[0]->x, width - 20);
    EXPECT_FALSE(place_labels({{5, 5, "a text that is wider than the whole plot"}}, {}, 60, 20)[0]);
}

} // namespace
} // namespace gnomon::lab
