// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/compare.h"

#include <string>
#include <vector>

// What a search is to make small, and within which bounds.
namespace gnomon::lab {

/// "time<2x", "time<4ms", "bytes<64MiB", "leak<0.001": a metric, time or bytes below a value, or below a multiple of the reference's.
struct Constraint {
    std::string quantity;
    double limit = 0; ///< milliseconds, bytes, or the metric's unit; a factor where relative
    bool relative = false;
    std::string text; ///< as it was written
};
/// Throws base::Error on an unknown quantity, a number that is none, or a unit that does not fit.
Constraint parse_constraint(const std::string& text);
/// "4ms", "2x" (times as long) or "64MiB": the same without the quantity, which the unit tells.
Constraint parse_budget(const std::string& text);

/// "leak+acne": the quantities whose sum is minimised: metrics, or time and bytes as multiples of the reference's. Throws base::Error.
std::vector<std::string> parse_sum(const std::string& text);
/// "leak+acne,mae": sums, each of which is to be small as a part of what it was. Throws base::Error.
std::vector<std::vector<std::string>> parse_terms(const std::string& text);

/// What a run has of a quantity: a metric, time (milliseconds) or bytes. Metrics that have a sign count by their size. Throws base::Error
/// where it was not measured, as those of hard lights under a soft one.
double quantity_of(const Run&, const std::string& quantity);
bool is_cost(const std::string& quantity); ///< time or bytes: what depends on more than the picture

/// By which part of a limit a value is above it, 0 where it is not.
double missed_by(double value, double limit);
std::string quantity_text(const std::string& quantity, double value); ///< with its unit

} // namespace gnomon::lab
