// SPDX-License-Identifier: Apache-2.0
#include "lab/search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <random>

namespace gnomon::lab {

namespace {

/// The root of x^(d+1) = x + 1, whose powers have the most even multiples in d dimensions (Roberts 2018, "The Unreasonable
/// Effectiveness of Quasirandom Sequences").
double even_ratio(size_t dimensions)
{
    double x = 2.0;
    for (int i = 0; i < 64; ++i) x = std::pow(1.0 + x, 1.0 / double(dimensions + 1));
    return x;
}

class Search {
public:
    explicit Search(const SearchOptions& options)
        : options_(options)
        , random_(options.seed)
        , limit_(options.budget * options.places)
    {
    }

    SearchResult run()
    {
        SearchResult out;
        out.start = *at_all(options_.start);
        std::vector<Point> seeds = {options_.start};
        // no axis has anything to choose: the start is all there is
        if (!options_.axes.empty()) {
            for (Point& p : halved(scattered())) seeds.push_back(std::move(p));
            std::stable_sort(seeds.begin(), seeds.end(), [&](const Point& a, const Point& b) { return better(known(a), known(b)); });
            for (const Point& seed : seeds) descend(seed);
        }
        out.best = best_, out.reading = best_reading_, out.readings = readings_;
        return out;
    }

private:
    bool spent() const { return readings_ >= limit_; }

    /// Nothing where the budget is spent.
    std::optional<Reading> at(const Point& point, size_t place)
    {
        std::vector<std::optional<Reading>>& all = seen_[point];
        all.resize(options_.places);
        if (!all[place]) {
            if (spent() && point != options_.start) return {};
            all[place] = options_.measure(point, place);
            ++readings_;
        }
        return all[place];
    }

    /// The mean over `places`, or, where the sum so far already loses against `bound`, that sum over all of them.
    std::optional<Reading> over(const Point& point, const std::vector<size_t>& places, const Reading* bound = nullptr)
    {
        Reading sum;
        for (const size_t place : places) {
            const std::optional<Reading> one = at(point, place);
            if (!one) return {};
            sum.value += one->value / double(places.size()), sum.violation += one->violation / double(places.size());
            if (bound && !better(sum, *bound)) break;
        }
        return sum;
    }

    std::vector<size_t> places(size_t count) const
    {
        std::vector<size_t> out(count);
        std::iota(out.begin(), out.end(), size_t(0));
        return out;
    }

    std::optional<Reading> at_all(const Point& point)
    {
        const std::optional<Reading> reading = over(point, places(options_.places));
        if (reading) keep(point, *reading);
        return reading;
    }

    void keep(const Point& point, const Reading& reading)
    {
        if (!best_.empty() && !better(reading, best_reading_)) return;
        const bool first = best_.empty();
        best_ = point, best_reading_ = reading;
        // where the incumbent is worst, a worse one shows first
        order_ = places(options_.places);
        std::stable_sort(order_.begin(), order_.end(), [&](size_t a, size_t b) { return at(point, a)->value > at(point, b)->value; });
        if (!first && options_.improved) options_.improved(point, reading);
    }

    Reading known(const Point& point) { return *over(point, places(options_.places)); }

    /// How many places each round of halving has.
    std::vector<size_t> rounds() const
    {
        std::vector<size_t> out = {options_.places};
        while (out.size() < 3 && out.back() > 1) out.push_back((out.back() + 2) / 3);
        return {out.rbegin(), out.rend()};
    }

    std::vector<Point> scattered()
    {
        const std::vector<size_t> round = rounds();
        double cost = 0, share = 1; // of one point, in readings
        for (size_t r = 0, before = 0; r < round.size(); before = round[r++], share /= 3) cost += share * double(round[r] - before);
        const size_t count = size_t(0.5 * double(limit_) / cost), dimensions = options_.axes.size();
        std::uniform_real_distribution<double> uniform;
        std::vector<double> offset(dimensions), step(dimensions);
        for (size_t d = 0; d < dimensions; ++d) offset[d] = uniform(random_), step[d] = std::pow(even_ratio(dimensions), -double(d + 1));
        std::vector<Point> out;
        for (size_t i = 0; i < count; ++i) {
            Point p = options_.start;
            for (size_t d = 0; d < dimensions; ++d) {
                const double turn = offset[d] + double(i + 1) * step[d];
                const bool changed = i % 2 == 0 || uniform(random_) < 2.0 / double(dimensions);
                if (changed) p[d] = options_.axes[d].value(turn - std::floor(turn));
            }
            if (std::find(out.begin(), out.end(), p) == out.end()) out.push_back(p);
        }
        return out;
    }

    /// Those that were measured at all places.
    std::vector<Point> halved(std::vector<Point> points)
    {
        const std::vector<size_t> round = rounds();
        for (size_t r = 0; r < round.size(); ++r) {
            std::vector<std::pair<Reading, Point>> read;
            for (Point& p : points)
                if (const std::optional<Reading> reading = over(p, places(round[r]))) read.emplace_back(*reading, std::move(p));
            std::stable_sort(read.begin(), read.end(), [](const auto& a, const auto& b) { return better(a.first, b.first); });
            if (r + 1 < round.size()) read.resize(std::min(read.size(), (read.size() + 2) / 3));
            points.clear();
            for (auto& [reading, p] : read) points.push_back(std::move(p));
        }
        for (const Point& p : points) at_all(p);
        return points;
    }

    /// Takes `to` where it is better than `from`.
    bool step(Point& from, Reading& reading, const Point& to)
    {
        if (to == from) return false;
        const std::optional<Reading> found = over(to, order_, &reading);
        if (!found || !better(*found, reading)) return false;
        from = to, reading = *found;
        keep(to, *found);
        return true;
    }

    bool step_along(Point& point, Reading& reading, size_t d, double size)
    {
        const Axis& axis = options_.axes[d];
        const auto with = [&](double v) {
            Point p = point;
            p[d] = v;
            return p;
        };
        if (axis.ordered())
            return step(point, reading, with(axis.moved(point[d], size))) || step(point, reading, with(axis.moved(point[d], -size)));
        bool moved = false;
        for (int word = 0; word < axis.count(); ++word) moved |= step(point, reading, with(double(word)));
        return moved;
    }

    void descend(const Point& seed)
    {
        Point point = seed;
        Reading reading = known(seed);
        for (double size = 0.25; size > 1.0 / 256.0 && !spent();) {
            const Point before = point;
            std::vector<size_t> order = places(options_.axes.size());
            std::shuffle(order.begin(), order.end(), random_);
            for (const size_t d : order) step_along(point, reading, d, size);
            if (point == before) {
                size *= 0.5;
                continue;
            }
            // once more as far in the direction that helped
            Point further = point;
            for (size_t d = 0; d < further.size(); ++d) {
                const Axis& axis = options_.axes[d];
                if (axis.ordered()) further[d] = axis.value(2.0 * axis.unit(point[d]) - axis.unit(before[d]));
            }
            step(point, reading, further);
        }
    }

    const SearchOptions& options_;
    std::mt19937_64 random_;
    size_t limit_, readings_ = 0;
    std::map<Point, std::vector<std::optional<Reading>>> seen_;
    Point best_;
    Reading best_reading_;
    std::vector<size_t> order_; ///< of places
};

} // namespace

bool better(const Reading& a, const Reading& b) { return a.violation != b.violation ? a.violation < b.violation : a.value < b.value; }

SearchResult search(const SearchOptions& options) { return Search(options).run(); }

} // namespace gnomon::lab
