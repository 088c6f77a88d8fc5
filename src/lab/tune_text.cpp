// SPDX-License-Identifier: Apache-2.0
#include "lab/tune.h"

#include <fmt/format.h>

namespace gnomon::lab {

std::vector<std::string> set_names(const std::string& choice)
{
    std::vector<std::string> out;
    for (size_t at = choice.find(':'); at != std::string::npos; at = choice.find(':', at + 1))
        out.push_back(choice.substr(at + 1, choice.find('=', at) - at - 1));
    return out;
}

std::string tune_text(const Tuned& tuned)
{
    const Preset& p = tuned.preset;
    std::string out = fmt::format("{} after {} evaluations: {}\n", p.minimise, p.evaluations, choice_text(p.choice));
    const auto table = [&](const char* title, const std::vector<Preset::Place>& places) {
        if (places.empty()) return;
        const auto line = [&](const std::string& what, const std::vector<double>& terms, double ratio) {
            out += fmt::format("  {:<48}", what);
            for (const double t : terms) out += fmt::format(" {:>9.4f}", t);
            out += fmt::format(" {:>9.4f}\n", ratio);
        };
        const Ratios all = ratios(places);
        out += fmt::format("{}: each term as a part of the start's, and their mean\n", title);
        for (const Preset::Place& q : places) line(fmt::format("{}, {}, {}", q.scene, q.camera, q.light), q.ratios, q.ratio());
        line(fmt::format("mean (standard error {:.4f})", all.error), all.terms, all.mean);
    };
    table("searched", p.tuning);
    table("validation", p.validation);
    if (!tuned.improved) out += "nothing better than the start was found\n";
    if (!tuned.written)
        out += "no preset was written: in validation it gains no more than the standard error and half a percent, or a term is worse by "
               "more than a percent, or a bound is not kept\n";
    return out;
}

} // namespace gnomon::lab
