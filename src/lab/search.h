// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// The smallest value of a function that is dear to measure, has no derivative and takes words as well as numbers.
namespace gnomon::lab {

/// One coordinate. Steps are taken on [0, 1], where a logarithmic axis has its decades at equal distances.
class Axis {
public:
    enum class Scale { linear, logarithmic, zero_and_logarithmic }; ///< the last: 0 itself, and five decades below the end

    static Axis words(int count) { return {0, double(count - 1), Scale::linear, true, false}; } ///< 0, 1 ... without an order
    static Axis real(double low, double high, Scale scale = Scale::linear) { return {low, high, scale, false, true}; }
    static Axis integer(double low, double high, Scale scale = Scale::linear) { return {low, high, scale, true, true}; }

    bool ordered() const { return ordered_; }
    int count() const { return int(high_ - low_) + 1; } ///< of words
    double value(double unit) const; ///< a whole number, or one of three digits
    double unit(double value) const;
    double moved(double value, double by) const; ///< the nearest other value at least where `by` has less effect; at an end, the same

private:
    Axis(double low, double high, Scale scale, bool whole, bool ordered)
        : low_(low)
        , high_(high)
        , scale_(scale)
        , whole_(whole)
        , ordered_(ordered)
    {
    }
    double low_, high_;
    Scale scale_;
    bool whole_, ordered_;
};

using Point = std::vector<double>; ///< a value for each axis

/// What was measured at one place, or the mean over all.
struct Reading {
    double value = 0;
    double violation = 0; ///< how far a constraint is missed; 0 = it is kept
};
/// Whoever keeps the constraints wins, then who misses them less, then the smaller value.
bool better(const Reading& a, const Reading& b);

struct SearchOptions {
    std::vector<Axis> axes;
    Point start;
    size_t places = 1; ///< a point's reading is the mean of those at all places
    size_t budget = 100; ///< points' worth of readings: budget * places are made at most, and those of `start`
    uint64_t seed = 1;
    std::function<Reading(const Point&, size_t place)> measure;
    std::function<void(const Point&, const Reading&)> improved; ///< after each new best point that is known at all places; may be empty
};
struct SearchResult {
    Point best;
    Reading reading, start;
    size_t readings = 0;
};

/// Half of the budget is for points that cover the space evenly (a Roberts sequence; every second one, and with more than six axes each,
/// differs from the start in about two axes only), measured at few places first, of which the better third goes on to more; the rest for a
/// pattern search (Hooke and Jeeves 1961) from the best of them, each step of which is a race: places are read in a shuffled order, and the
/// step is given up once Student's test of the differences so far puts it above its origin (as in F-Race, Birattari et al.
/// 2002), which is at once where they are all 0, because another parameter switches this one off. The same options give the same points.
SearchResult search(const SearchOptions&);

} // namespace gnomon::lab
