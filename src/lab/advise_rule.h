// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/halving.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

// How advice is chosen from measurements, whatever makes them: nothing here knows a technique or a device.
namespace gnomon::lab {

/// What a choice has to keep; several bounds hold together.
struct Budget {
    double ms = std::numeric_limits<double>::infinity();
    double times = std::numeric_limits<double>::infinity(); ///< as many times the reference's milliseconds
    double bytes = std::numeric_limits<double>::infinity();
};

/// A candidate at one size of picture.
struct Reading {
    double error = 0;
    double ms = 0; ///< the least of all frames: what other programs take of the machine only ever adds to a frame
    double mean_ms = 0, deviation_ms = 0; ///< of the first reading's frames
    uint64_t bytes = 0;
};

/// Told how many frames were timed and the least of them, whether one more is worth its while.
using Again = std::function<bool(int frames, double least_ms)>;

/// What measures. Rounds count from 0; the last is the full size.
struct Gauges {
    std::function<std::optional<Reading>(size_t candidate, int round, const Again&)> measure; ///< nothing: it cannot run
    std::function<double(size_t candidate, const Again&)> time; ///< the least milliseconds of a few more frames at full size
    std::function<double(const Again&)> time_reference; ///< the same of the reference
    std::function<bool(size_t a, size_t b)> costs_more; ///< a is b with more of what takes time
    std::function<void()> passed_over{}; ///< told, where given, in place of a measurement that could not win
};

class Rule {
public:
    Rule(size_t candidates, Budget, Gauges, int frames); ///< frames: at least so many at full size
    static constexpr int rounds = 3;

    /// Measures every candidate at full size as well, so that best_of_all() is true. Before run().
    void measure_all();
    void run();

    const std::vector<size_t>& finalists() const { return finalists_; } ///< measured at full size by the rule
    std::optional<size_t> chosen() const { return least(finalists_); } ///< errs least of the finalists within the budget
    std::optional<size_t> best_of_all() const { return least(measured()); }
    const Reading& reading(size_t candidate) const { return full_.at(candidate); }
    double excess(const Reading&) const; ///< by which part it is over the budget; 0 = within
    double reference_ms() const { return reference_ms_; } ///< 0 where no bound is relative
    bool better(size_t a, size_t b) const; ///< both measured at full size: less error, then less time

private:
    std::optional<Trial> trial(size_t candidate, int round);
    std::optional<size_t> least(const std::vector<size_t>& among) const;
    std::vector<size_t> measured() const;
    bool too_dear(size_t candidate, int round) const;
    double limit_ms() const;
    Again patience(int round) const;
    void settle(std::vector<size_t> among);
    void time_reference();

    size_t candidates_;
    Budget budget_;
    Gauges gauges_;
    int frames_;
    double reference_ms_ = 0;
    std::map<std::pair<size_t, int>, std::optional<Reading>> seen_;
    std::map<size_t, Reading> full_; ///< by candidate
    std::vector<size_t> finalists_;
};

} // namespace gnomon::lab
