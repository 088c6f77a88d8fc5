// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

// Which of many candidates deserve a dear measurement, told by cheap ones.
namespace gnomon::lab {

struct Trial {
    double error = 0, time = 0;
    double excess = 0; ///< by which part it is over the budget; 0 = within
};

struct HalvingOptions {
    size_t candidates = 0;
    int rounds = 3; ///< each costs more than the one before; the last is the true measurement
    size_t least = 8; ///< that reach the last round, where there are as many
    double slack = 1.0; ///< over the budget by more than this in a cheap round, whose pictures are smaller: out
    std::function<std::optional<Trial>(size_t candidate, int round)> measure; ///< nothing: it cannot run
};

/// A third of those that are left goes on to the next round: alternately the one with the least error and the one on the foremost Pareto front
/// of error and time, and two that keep the budget for each that is
/// over it by no more than the slack. Where none is within that, those go on that are least over it. Returns the candidates of the last
/// round, in their order.
std::vector<size_t> halve(const HalvingOptions&);

/// The trials that no other one beats in both error and time, fastest first.
std::vector<size_t> pareto_front(const std::vector<Trial>&);

} // namespace gnomon::lab
