// SPDX-License-Identifier: Apache-2.0
#include "lab/advise_rule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::lab {
namespace {

/// Candidates of which all is known, measured as a busy machine measures: small pictures err a little otherwise and take less, and other
/// programs add to frames.
struct Bench {
    struct Item {
        double error, ms, fixed; ///< fixed: the part of its time that does not depend on the picture's size
    };
    std::vector<Item> items;
    double reference_ms = 10;
    double load = 0; ///< how often a frame is disturbed
    double noise[3] = {0.25, 0.12, 0}; ///< of errors' logarithms, by round
    std::mt19937 random;
    std::vector<int> made = std::vector<int>(3, 0);
    int frames_at_full_size = 0;

    Bench(unsigned seed, size_t count)
        : random(seed)
    {
        std::uniform_real_distribution<double> uniform(0, 1);
        std::normal_distribution<double> normal;
        for (size_t i = 0; i < count; ++i) {
            const double ms = 5 * std::exp(1.2 * normal(random) + 1.0);
            // what takes longer errs less, more or less
            items.push_back({0.02 * std::exp(0.6 * normal(random)) * std::pow(ms / 10, -0.3), ms, 0.3 + 0.6 * uniform(random)});
        }
    }

    double frame(double ms)
    {
        std::uniform_real_distribution<double> uniform(0, 1);
        const double disturbed = uniform(random), by = uniform(random);
        return disturbed < load ? ms * (1 + by) : ms * (1 + 0.01 * by);
    }
    double frames(double ms, const Again& again, int* count = nullptr)
    {
        double least = frame(ms);
        int n = 1;
        for (; again(n, least); ++n) least = std::min(least, frame(ms));
        if (count) *count = n;
        return least;
    }
    Gauges gauges()
    {
        const auto measure = [this](size_t i, int round, const Again& again) -> std::optional<Reading> {
            ++made[size_t(round)];
            const Item& item = items[i];
            const double pixels = std::pow(4.0, round - 2), ms = item.ms * (item.fixed + (1 - item.fixed) * pixels);
            // a generator of its own: the same picture errs the same whenever it is made
            std::mt19937 own(unsigned(i * 3) + unsigned(round));
            std::normal_distribution<double> normal;
            int n = 0;
            const double least = frames(ms, again, &n);
            if (round == 2) frames_at_full_size = std::max(frames_at_full_size, n);
            return Reading{.error = item.error * std::exp(noise[round] * normal(own)), .ms = least, .mean_ms = least, .bytes = uint64_t(i)};
        };
        return {.measure = measure,
            .time = [this](size_t i, const Again& again) { return frames(items[i].ms, again); },
            .time_reference = [this](const Again& again) { return frames(reference_ms, again); },
            .costs_more = [](size_t, size_t) { return false; }};
    }
    /// The least error of those that truly keep the budget.
    double best(double limit) const
    {
        double out = std::numeric_limits<double>::infinity();
        for (const Item& item : items)
            if (item.ms <= limit) out = std::min(out, item.error);
        return out;
    }
};

TEST(AdviseRule, FindsWithinTenPercentOfTheBest)
{
    for (unsigned seed = 1; seed <= 60; ++seed) {
        Bench bench(seed, 40 + 2 * seed);
        const double factor = 1 + 0.05 * seed, best = bench.best(factor * bench.reference_ms);
        Rule rule(bench.items.size(), {.times = factor}, bench.gauges(), 3);
        rule.run();
        ASSERT_TRUE(rule.chosen()) << seed;
        EXPECT_LE(rule.reading(*rule.chosen()).error, 1.1 * best) << seed;
        EXPECT_LT(bench.made[2], bench.made[0]) << seed;
    }
}

TEST(AdviseRule, IsNotMisledByABusyMachine)
{
    for (unsigned seed = 1; seed <= 60; ++seed) {
        Bench bench(seed, 100);
        bench.load = 0.7;
        Rule rule(bench.items.size(), {.times = 2}, bench.gauges(), 3);
        rule.run();
        ASSERT_TRUE(rule.chosen()) << seed;
        EXPECT_LE(rule.reading(*rule.chosen()).error, 1.1 * bench.best(20)) << seed;
        EXPECT_LE(bench.items[*rule.chosen()].ms, 20 * 1.02) << seed << ": what it chose does not truly keep the budget";
    }
}

TEST(AdviseRule, FindsTheSameInTheSame)
{
    const auto choose = [] {
        Bench bench(7, 120);
        bench.load = 0.5;
        Rule rule(bench.items.size(), {.ms = 15}, bench.gauges(), 3);
        rule.run();
        return std::pair(rule.chosen(), rule.finalists());
    };
    EXPECT_EQ(choose(), choose());
}

TEST(AdviseRule, HoldsAllBounds)
{
    Bench bench(3, 80);
    Rule rule(80, {.ms = 12, .times = 2, .bytes = 40}, bench.gauges(), 3);
    rule.run();
    ASSERT_TRUE(rule.chosen());
    EXPECT_LE(*rule.chosen(), 40u) << "bytes are the candidate's number here";
    EXPECT_LE(rule.reading(*rule.chosen()).ms, 12);

    Bench free(3, 80);
    Rule unbound(80, {}, free.gauges(), 3);
    unbound.run();
    EXPECT_EQ(unbound.reference_ms(), 0) << "nothing refers to it";
    EXPECT_LE(unbound.reading(*unbound.chosen()).error, 1.1 * free.best(1e9));
    EXPECT_EQ(free.frames_at_full_size, 3);
}

TEST(AdviseRule, ChoosesNothingWhereNothingKeepsTheBudget)
{
    Bench bench(5, 50);
    Rule rule(50, {.ms = 1e-6}, bench.gauges(), 3);
    rule.run();
    EXPECT_FALSE(rule.chosen());
    EXPECT_FALSE(rule.finalists().empty()) << "the nearest can be named";
}

TEST(AdviseRule, MeasuresNoMoreOfWhatTakesFarTooLong)
{
    Bench bench(9, 3);
    bench.items = {{0.1, 5, 1}, {0.05, 100, 1}, {0.01, 200, 1}};
    Gauges gauges = bench.gauges();
    gauges.costs_more = [](size_t a, size_t b) { return a == 2 && b == 1; };
    Rule rule(3, {.ms = 10}, gauges, 3);
    rule.measure_all();
    rule.run();
    EXPECT_EQ(rule.chosen(), 0u);
    EXPECT_EQ(rule.best_of_all(), 0u);
    EXPECT_EQ(bench.made[0], 2) << "the third is the second with more";
    EXPECT_EQ(bench.made[2], 2) << "measured once for both";
}

TEST(AdviseRule, ComparesWithAllThatWereMeasured)
{
    Bench bench(11, 90);
    // small pictures that tell nothing
    bench.noise[0] = bench.noise[1] = 3;
    Rule rule(90, {.ms = 30}, bench.gauges(), 3);
    rule.measure_all();
    rule.run();
    ASSERT_TRUE(rule.best_of_all());
    EXPECT_EQ(rule.reading(*rule.best_of_all()).error, bench.best(30));
    EXPECT_GE(rule.reading(*rule.chosen()).error, bench.best(30));
    EXPECT_EQ(bench.made[2], 90);
}

} // namespace
} // namespace gnomon::lab
