// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include "lab/goal.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::lab {

namespace {

std::string budget_text(const Advice& a) { return fmt::format("{}", fmt::join(a.budget, " and ")); }

std::string cost(const Advice& a, const Measured& m)
{
    return fmt::format(
        "{} {:.4g} in {:.4g} ms and {}", a.metric, m.reading.error, m.reading.ms, quantity_text("bytes", double(m.reading.bytes)));
}

bool lets_through(const Measured& m) { return output_of(m.choice) == shadow::Output::transmittance; }

/// The one that errs least of those that `fits` takes; null where there is none.
template <class Fits> const Measured* least(const std::vector<Measured>& among, Fits fits)
{
    const Measured* out = nullptr;
    for (const Measured& m : among)
        if (fits(m) && (!out || m.reading.error < out->reading.error)) out = &m;
    return out;
}

void add_budget(const Advice& a, std::vector<std::string>& out)
{
    for (const std::string& text : a.budget)
        if (const Constraint c = parse_budget(text); c.relative)
            out.push_back(fmt::format(
                "the budget of {} is {:.4g} ms here: {} takes {:.4g} ms", text, c.limit * a.reference_ms, a.reference, a.reference_ms));
}

/// What of its error the choice owes to the scene rather than to its settings.
void add_limits(const Advice& a, std::vector<std::string>& out)
{
    const shadow::TechniqueInfo& info = *a.chosen->choice.info;
    const char* keeps = a.budget.empty() ? "was measured" : "keeps the budget";
    if (a.features.soft && !info.soft)
        out.push_back(fmt::format("it takes the light as a point, and yet nothing with penumbrae that {} errs less", keeps));
    if (!a.features.see_through || lets_through(*a.chosen)) return;
    const Measured* through = least(a.measured, lets_through);
    out.push_back("it lets no light through semitransparent casters, which is a part of its error"
        + (through ? fmt::format("; of those that do, {} errs least: {}{}", choice_text(through->choice), cost(a, *through),
               through->excess > 0 ? ", over the budget" : "")
                   : std::string("; none that does came as far as the full size")));
}

void add_others(const Advice& a, std::vector<std::string>& out)
{
    const Measured& best = *a.chosen;
    const Measured* other = least(a.measured, [&](const Measured& m) { return m.choice.info != best.choice.info && m.excess == 0; });
    if (other) out.push_back(fmt::format("the next technique is {}: {}", choice_text(other->choice), cost(a, *other)));
    const Measured* over = nullptr;
    for (const Measured& m : a.measured)
        if (m.excess > 0 && m.reading.error < best.reading.error && (!over || m.excess < over->excess)) over = &m;
    if (over) out.push_back(fmt::format("with more to spend there is {}: {}", choice_text(over->choice), cost(a, *over)));
}

} // namespace

std::vector<std::string> advice_reasons(const Advice& a)
{
    std::vector<std::string> out = feature_sentences(a.features);
    add_budget(a, out);
    out.push_back(fmt::format("{} settings of {} techniques fit; small pictures left {} to measure at the full {}x{}", a.candidates,
        a.techniques, a.measured.size(), a.size.width, a.size.height));
    if (!a.chosen) return out;
    out.push_back(fmt::format("{} errs least{}: {}", choice_text(a.chosen->choice),
        a.budget.empty() ? "" : " of those within " + budget_text(a), cost(a, *a.chosen)));
    if (a.chosen->choice.info->exact) out.push_back("its method is exact: only pixels on shadows' edges may differ");
    add_limits(a, out);
    add_others(a, out);
    return out;
}

std::string nothing_keeps(const Advice& a)
{
    const Measured& near
        = *std::min_element(a.measured.begin(), a.measured.end(), [](const Measured& x, const Measured& y) { return x.excess < y.excess; });
    return fmt::format("nothing that fits keeps the budget of {}{}: nearest comes {} with {}; allow that, or take a smaller picture",
        budget_text(a), a.reference_ms > 0 ? fmt::format(" ({} takes {:.4g} ms)", a.reference, a.reference_ms) : "",
        choice_text(near.choice), cost(a, near));
}

} // namespace gnomon::lab
