// SPDX-License-Identifier: Apache-2.0
#include "lab/goal.h"

#include "base/error.h"
#include "base/names.h"
#include "metrics/metrics.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace gnomon::lab {

namespace {

/// By unit: what it measures, and how many milliseconds or bytes it has.
const std::map<std::string, std::pair<std::string, double>, std::less<>>& units()
{
    static const std::map<std::string, std::pair<std::string, double>, std::less<>> all
        = {{"us", {"time", 1e-3}}, {"ms", {"time", 1.0}}, {"s", {"time", 1e3}}, {"B", {"bytes", 1.0}}, {"KiB", {"bytes", 1024.0}},
            {"MiB", {"bytes", 1048576.0}}, {"GiB", {"bytes", 1073741824.0}}};
    return all;
}

const std::vector<std::string>& quantities()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> out = {"time", "bytes"};
        for (const auto* list : {&metrics::metrics(), &metrics::filter_metrics()})
            for (const metrics::Metric& m : *list) out.emplace_back(m.id);
        for (const char* banded : {"wrong_outside_band", "acne_outside_band", "leak_outside_band"})
            if (std::find(out.begin(), out.end(), banded) == out.end()) out.emplace_back(banded);
        return out;
    }();
    return names;
}

void check_quantity(const std::string& name)
{
    if (std::find(quantities().begin(), quantities().end(), name) == quantities().end())
        throw base::Error(base::unknown_name("metric", name, quantities()));
}

struct Amount {
    double number;
    std::string unit;
};

Amount parse_amount(const std::string& text, const std::string& whole)
{
    Amount out{};
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, out.number);
    if (error != std::errc() || !(out.number > 0) || !std::isfinite(out.number))
        base::fail("'{}' needs a number above 0, as in time<2x, time<4ms, bytes<64MiB or leak<0.001", whole);
    out.unit.assign(rest, end);
    if (out.unit.empty() || out.unit == "x" || units().count(out.unit)) return out;
    std::vector<std::string> names = {"x"};
    for (const auto& [name, meaning] : units()) names.push_back(name);
    base::fail("'{}': {}", whole, base::unknown_name("unit", out.unit, names));
}

} // namespace

Constraint parse_constraint(const std::string& text)
{
    const size_t sign = text.find('<');
    if (sign == std::string::npos) base::fail("'{}' is no constraint; write one as time<2x, bytes<64MiB or leak<0.001", text);
    Constraint out{text.substr(0, sign), 0, false, text};
    check_quantity(out.quantity);
    const Amount amount = parse_amount(text.substr(sign + 1), text);
    out.limit = amount.number, out.relative = amount.unit == "x";
    if (out.relative) return out;
    if (is_cost(out.quantity) && amount.unit.empty()) base::fail("'{}' lacks a unit: ms or x for time, MiB or x for bytes", text);
    if (amount.unit.empty()) return out;
    const auto& [measured, factor] = units().at(amount.unit);
    if (measured != out.quantity) base::fail("'{}': {} is not measured in {}", text, out.quantity, amount.unit);
    out.limit *= factor;
    return out;
}

Constraint parse_budget(const std::string& text)
{
    const Amount amount = parse_amount(text, text);
    if (amount.unit.empty()) base::fail("the budget '{}' lacks a unit: 4ms, 2x (the reference's time) or 64MiB", text);
    return parse_constraint((amount.unit == "x" ? "time" : units().at(amount.unit).first) + "<" + text);
}

std::vector<std::string> parse_sum(const std::string& text)
{
    std::vector<std::string> out;
    for (size_t from = 0; from <= text.size();) {
        const size_t to = std::min(text.find('+', from), text.size());
        out.push_back(text.substr(from, to - from));
        check_quantity(out.back());
        from = to + 1;
    }
    return out;
}

std::vector<std::vector<std::string>> parse_terms(const std::string& text)
{
    std::vector<std::vector<std::string>> out;
    for (size_t from = 0; from <= text.size();) {
        const size_t to = std::min(text.find(',', from), text.size());
        out.push_back(parse_sum(text.substr(from, to - from)));
        from = to + 1;
    }
    return out;
}

bool is_cost(const std::string& quantity) { return quantity == "time" || quantity == "bytes"; }

double quantity_of(const Run& run, const std::string& quantity)
{
    if (quantity == "time") return run.technique_ms;
    if (quantity == "bytes") return double(run.bytes);
    const auto found = run.metrics.find(quantity);
    if (found != run.metrics.end()) return std::abs(found->second);
    if (quantity.rfind("filter_", 0) == 0)
        base::fail("{} is measured against a reference technique; name one with --reference{}{}", quantity,
            run.reference_refused.empty() ? "" : ", another than this one: ", run.reference_refused);
    base::fail(
        "{} is not measured under the light '{}' of {}; docs/results.md says which metrics are for hard lights and which for soft ones",
        quantity, run.light, run.scene);
}

double missed_by(double value, double limit)
{
    if (value <= limit) return 0.0;
    return limit > 0.0 ? value / limit - 1.0 : value;
}

std::string quantity_text(const std::string& quantity, double value)
{
    if (quantity == "time") return fmt::format("{:.4g} ms", value);
    if (quantity == "bytes") return fmt::format("{:.4g} MiB", value / 1048576.0);
    return fmt::format("{:.4g}", value);
}

} // namespace gnomon::lab
