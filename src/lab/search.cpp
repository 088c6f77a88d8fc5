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
        , order_(options.places)
    {
        // places of one scene stand together; the first few are to stand for all
        std::iota(order_.begin(), order_.end(), size_t(0));
        std::shuffle(order_.begin(), order_.end(), random_);
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

    /// The mean over the first `count` places.
    std::optional<Reading> over(const Point& point, size_t count)
    {
        Reading mean;
        for (size_t i = 0; i < count; ++i) {
            const std::optional<Reading> one = at(point, order_[i]);
            if (!one) return {};
            mean.value += one->value / double(count), mean.violation += one->violation / double(count);
        }
        return mean;
    }

    /// Whether `point`, read at the first `count` places, loses against `from`: it breaks more constraints than `from` at all places, or
    /// lies above it by more than the deviation of their differences allows. Where they are all 0, the parameter that was moved has no
    /// effect: another one switches it off.
    bool loses(const Point& point, const Point& from, const Reading& reading, size_t count)
    {
        double violation = 0, mean = 0, squares = 0;
        for (size_t i = 0; i < count; ++i) {
            const Reading now = *at(point, order_[i]), before = *at(from, order_[i]);
            violation += now.violation / double(options_.places);
            mean += (now.value - before.value) / double(count);
            squares += (now.value - before.value) * (now.value - before.value) / double(count);
        }
        if (violation > reading.violation) return true;
        constexpr size_t least = 3; // fewer have no deviation to speak of
        if (count < least || violation < reading.violation || reading.violation > 0) return false;
        const double freedom = double(count - 1),
                     quantile = 2.0 + 9.0 / (freedom * freedom); // Student's, one side of 2.5 %, within a tenth
        return mean >= quantile * std::sqrt(std::max(0.0, squares - mean * mean) / freedom);
    }

    std::optional<Reading> at_all(const Point& point)
    {
        const std::optional<Reading> reading = over(point, options_.places);
        if (reading) keep(point, *reading);
        return reading;
    }

    void keep(const Point& point, const Reading& reading)
    {
        if (!best_.empty() && !better(reading, best_reading_)) return;
        const bool first = best_.empty();
        best_ = point, best_reading_ = reading;
        if (!first && options_.improved) options_.improved(point, reading);
    }

    Reading known(const Point& point) { return *over(point, options_.places); }

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
        constexpr size_t few = 6;
        std::vector<Point> out;
        for (size_t i = 0; i < count; ++i) {
            Point p = options_.start;
            for (size_t d = 0; d < dimensions; ++d) {
                const double turn = offset[d] + double(i + 1) * step[d];
                // among many axes, a point that changes all is next to never a good one
                const bool changed = (i % 2 == 0 && dimensions <= few) || uniform(random_) < 2.0 / double(dimensions);
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
                if (const std::optional<Reading> reading = over(p, round[r])) read.emplace_back(*reading, std::move(p));
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
        for (size_t i = 0; i < order_.size(); ++i)
            if (!at(to, order_[i]) || loses(to, from, reading, i + 1)) return false;
        const std::optional<Reading> found = over(to, order_.size());
        if (!better(*found, reading)) return false;
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
            std::vector<size_t> order(options_.axes.size());
            std::iota(order.begin(), order.end(), size_t(0));
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
    std::vector<size_t> order_; ///< in which places are read
};

} // namespace

bool better(const Reading& a, const Reading& b) { return a.violation != b.violation ? a.violation < b.violation : a.value < b.value; }

SearchResult search(const SearchOptions& options) { return Search(options).run(); }

} // namespace gnomon::lab
