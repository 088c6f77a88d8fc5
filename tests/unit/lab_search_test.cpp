// SPDX-License-Identifier: Apache-2.0
#include "lab/search.h"

#include "lab/search_space.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gnomon::lab {
namespace {

using Scale = Axis::Scale;

SearchOptions searching(std::vector<Axis> axes, Point start, std::function<Reading(const Point&, size_t)> measure, size_t budget = 200)
{
    return {.axes = std::move(axes), .start = std::move(start), .budget = budget, .measure = std::move(measure)};
}

TEST(SearchAxis, GoesToUnitAndBack)
{
    for (const Axis& axis : {Axis::words(4), Axis::integer(1, 15), Axis::integer(16, 8192, Scale::logarithmic), Axis::real(0, 1),
             Axis::real(0.001, 100, Scale::logarithmic), Axis::real(0, 64, Scale::zero_and_logarithmic)})
        for (double u = 0; u <= 1; u += 1.0 / 64) {
            const double v = axis.value(u);
            EXPECT_EQ(axis.value(axis.unit(v)), v) << u;
        }
    EXPECT_EQ(Axis::real(0, 64, Scale::zero_and_logarithmic).value(0.01), 0);
    EXPECT_EQ(Axis::real(0, 64, Scale::zero_and_logarithmic).value(1), 64);
    EXPECT_NEAR(Axis::integer(16, 8192, Scale::logarithmic).value(0.5), std::sqrt(16.0 * 8192.0), 1);
}

TEST(SearchAxis, MovesAtLeastToTheNextValueAndNeverOut)
{
    const Axis few = Axis::integer(1, 15);
    EXPECT_EQ(few.moved(3, 0.001), 4);
    EXPECT_EQ(few.moved(3, -0.001), 2);
    EXPECT_EQ(few.moved(15, 0.25), 15);
    const Axis zero = Axis::real(0, 100, Scale::zero_and_logarithmic);
    EXPECT_GT(zero.moved(0, 0.01), 0);
    EXPECT_EQ(zero.moved(0, -0.01), 0);
}

TEST(Search, FindsTheLowestPointOfABowl)
{
    const auto bowl = [](const Point& p, size_t) { return Reading{std::pow(p[0] - 0.3, 2) + std::pow(p[1] + 1.7, 2), 0}; };
    const SearchResult found = search(searching({Axis::real(-5, 5), Axis::real(-5, 5)}, {4, 4}, bowl));
    EXPECT_LT(found.reading.value, 1e-3);
    EXPECT_NEAR(found.best[0], 0.3, 0.03);
    EXPECT_NEAR(found.best[1], -1.7, 0.03);
    EXPECT_LE(found.readings, 200u);
    EXPECT_DOUBLE_EQ(found.start.value, std::pow(3.7, 2) + std::pow(5.7, 2));
}

TEST(Search, FollowsABentValley)
{
    // Rosenbrock's function, lowest at (1, 1); the start lies across the bend
    const auto valley = [](const Point& p, size_t) { return Reading{100 * std::pow(p[1] - p[0] * p[0], 2) + std::pow(1 - p[0], 2), 0}; };
    const SearchResult found = search(searching({Axis::real(-2, 2), Axis::real(-2, 2)}, {-1.2, 1}, valley, 600));
    EXPECT_LT(found.reading.value, 0.1);
}

TEST(Search, ChoosesAmongWordsAndDecades)
{
    // only under the third word does the number matter; it is best at 0.02 of a range that ends at 100
    const auto measure = [](const Point& p, size_t) {
        return Reading{p[0] == 2 ? std::abs(std::log10(std::max(p[1], 1e-6) / 0.02)) : 5.0, 0};
    };
    const SearchResult found = search(searching({Axis::words(5), Axis::real(0, 100, Scale::zero_and_logarithmic)}, {0, 0}, measure, 120));
    EXPECT_EQ(found.best[0], 2);
    EXPECT_NEAR(found.best[1], 0.02, 0.002);
}

TEST(Search, KeepsConstraintsBeforeItMinimises)
{
    // lowest at 0, where the constraint x >= 3 is broken
    const auto measure = [](const Point& p, size_t) { return Reading{p[0] * p[0], std::max(0.0, 3 - p[0])}; };
    const SearchResult found = search(searching({Axis::real(0, 10)}, {1}, measure, 80));
    EXPECT_EQ(found.reading.violation, 0);
    EXPECT_NEAR(found.best[0], 3, 0.05);
    // one that nothing keeps: the nearest
    const auto never = [](const Point& p, size_t) { return Reading{p[0], 1 + std::abs(p[0] - 7)}; };
    const SearchResult nearest = search(searching({Axis::integer(0, 10)}, {1}, never, 60));
    EXPECT_GT(nearest.reading.violation, 0);
    EXPECT_EQ(nearest.best[0], 7);
}

TEST(Search, MeansOverPlacesAndSavesReadingsThere)
{
    size_t readings = 0;
    std::set<std::pair<Point, size_t>> seen;
    SearchOptions options = searching({Axis::real(0, 1), Axis::real(0, 1)}, {1, 1}, nullptr, 60);
    options.places = 9;
    options.measure = [&](const Point& p, size_t place) {
        EXPECT_TRUE(seen.insert({p, place}).second) << "measured twice";
        ++readings;
        const double where = 0.1 * double(place); // 0 to 0.8: the mean is lowest at 0.4
        return Reading{std::pow(p[0] - where, 2) + std::pow(p[1] - 0.4, 2), 0};
    };
    Point last;
    double value = 1e9;
    options.improved = [&](const Point& p, const Reading& r) {
        EXPECT_LT(r.value, value) << "announced although it is no better";
        last = p, value = r.value;
    };
    const SearchResult found = search(options);
    EXPECT_NEAR(found.best[0], 0.4, 0.03);
    EXPECT_NEAR(found.best[1], 0.4, 0.03);
    EXPECT_EQ(last, found.best);
    EXPECT_EQ(readings, found.readings);
    EXPECT_LE(readings, 60u * 9u);
}

TEST(Search, LeavesAParameterThatAnotherSwitchesOffAfterAFewPlaces)
{
    // the second axis matters only under the second word, which is bad everywhere
    std::map<Point, size_t> readings;
    SearchOptions options = searching({Axis::words(2), Axis::real(0, 1)}, {0, 0.5}, nullptr, 20);
    options.places = 30;
    options.measure = [&](const Point& p, size_t place) {
        ++readings[p];
        return Reading{p[0] == 1 ? 3 + p[1] : 1 + 0.1 * double(place % 3), 0};
    };
    const SearchResult found = search(options);
    EXPECT_EQ(found.best, options.start);
    const auto whole = std::count_if(readings.begin(), readings.end(), [](const auto& r) { return r.second == 30; });
    EXPECT_GT(readings.size(), 60u) << "given up early, the budget of 20 points' readings reaches many more";
    EXPECT_LT(whole, 12);
}

TEST(Search, GivesAStepUpThatLosesClearlyAndNotOneThatIsNoisy)
{
    size_t clear = 0, noisy = 0;
    SearchOptions options = searching({Axis::words(3)}, {0}, nullptr, 3);
    options.places = 40;
    options.measure = [&](const Point& p, size_t place) {
        const double base = double(place % 7);
        if (p[0] == 1) return ++clear, Reading{base + 1 + 0.1 * double(place % 2), 0};
        if (p[0] == 2) return ++noisy, Reading{base + (place % 2 ? 2.0 : -2.5), 0};
        return Reading{base, 0};
    };
    const SearchResult found = search(options);
    EXPECT_EQ(found.best, Point{2}) << "better in the mean, worse in half of the places";
    EXPECT_EQ(noisy, 40u);
    EXPECT_LT(clear, 40u);
}

TEST(Search, IsTheSameEachTimeAndAnotherWithAnotherSeed)
{
    const auto trace = [](uint64_t seed) {
        std::vector<Point> points;
        SearchOptions options = searching({Axis::real(0, 1), Axis::words(3)}, {0.5, 0}, nullptr, 30);
        options.seed = seed;
        options.measure = [&](const Point& p, size_t) {
            points.push_back(p);
            return Reading{std::abs(p[0] - 0.77) + p[1], 0};
        };
        search(options);
        return points;
    };
    EXPECT_EQ(trace(1), trace(1));
    EXPECT_NE(trace(1), trace(2));
}

TEST(Search, WithNothingToChooseIsItsStart)
{
    const SearchResult found = search(searching({}, {}, [](const Point&, size_t) { return Reading{2, 0}; }));
    EXPECT_EQ(found.reading.value, 2);
    EXPECT_EQ(found.readings, 1u);
}

struct Params {
    int size = 1024, kind = 1, on = 1;
    float scale = 1, part = 0.5f;
};
void describe(Params& p, shadow::Fields& f)
{
    f.integer("size", p.size, {16, 8192}, "texels", "");
    f.choice("kind", p.kind, {"a", "b", "c"}, "");
    f.flag("on", p.on, "");
    f.real("scale", p.scale, {0, 64}, "", "");
    f.real("part", p.part, {0, 1}, "", "");
}

TEST(SearchSpace, ReadsAxesFromDeclaredParameters)
{
    const shadow::ParamValues start(shadow::param_table(describe));
    const SearchSpace space(start, {"kind", "scale", "size", "part"});
    ASSERT_EQ(space.axes().size(), 4u);
    EXPECT_FALSE(space.axes()[0].ordered());
    EXPECT_EQ(space.axes()[1].value(0), 0);
    EXPECT_LT(space.axes()[1].value(0.5), 1) << "64 is far above the default: decades";
    EXPECT_NEAR(space.axes()[2].value(0.5), 362, 1);
    EXPECT_EQ(space.axes()[3].value(0.5), 0.5);
    const Point p = space.point(start);
    EXPECT_EQ(p, (Point{1, 1, 1024, 0.5}));
    EXPECT_EQ(space.params(p).json(), start.json());
    EXPECT_EQ(space.params({2, 0.125, 64, 1}).json().dump(), R"({"size":64,"kind":"c","on":true,"scale":0.125,"part":1.0})");
    EXPECT_ANY_THROW(SearchSpace(start, {"scael"}));
}

} // namespace
} // namespace gnomon::lab
