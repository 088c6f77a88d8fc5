// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/advise_rule.h"
#include "lab/compare.h"
#include "lab/features.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// Which technique, with which parameters, for this scene, light and budget (docs/tune-and-advise.md).
namespace gnomon::lab {

enum class Prefer { any, exact, soft, stable };
Prefer parse_prefer(const std::string&); ///< throws base::Error

/// A technique that takes the light, with some of its parameters changed.
struct Candidate {
    Choice choice;
    std::string left_out; ///< why it is no candidate although its light fits; empty = it is one
};

/// From the registry by what techniques say of themselves, in settings that follow from the names of their parameters; those that were left
/// out come once each, with the reason. Nothing here names a technique.
std::vector<Candidate> find_candidates(const gpu::Device&, const Stage&, const Features&, Prefer);
/// The settings of one technique, those with small maps first; `see_through`: those as well that let light through semitransparent casters.
std::vector<Choice> settings(const shadow::TechniqueInfo&, const scene::Light&, Prefer, bool see_through = false);

/// Whether `a` is `b` with more of what it spends its time on, by the names of parameters, or with several maps for one, and else the same.
bool costs_more(const Choice& a, const Choice& b);

struct AdviseOptions {
    StageOptions stage; ///< its first light counts
    std::vector<std::string> budget; ///< parse_budget; all hold; empty = whatever it costs
    Prefer prefer = Prefer::any;
    std::string metric = "mae"; ///< parse_sum: what an error is
    std::string reference = "shadow_map:map_size=2048"; ///< what "2x" is twice of
    std::vector<std::string> without; ///< ids that are no candidates, as an engine may lack what they need
    bool exhaustive = false; ///< measure every candidate at full size as well, and say what the choice lost
    int truth_samples = 64, repeats = 3;
    std::filesystem::path truth_cache; ///< empty = the user's cache
};

struct Measured {
    Choice choice;
    Reading reading;
    double excess = 0; ///< by which part it is over the budget
};

/// A technique, or one of its settings, that could not be advised.
struct LeftOut {
    std::string what, why;
};

struct Advice {
    std::string scene, camera, light, device, driver, commit, metric, reference;
    std::vector<std::string> budget;
    base::Size size;
    Features features;
    double reference_ms = 0; ///< the least of its frames; 0 where the budget does not refer to it
    size_t candidates = 0, techniques = 0; ///< settings that began, and of how many techniques
    std::vector<Measured> measured; ///< at full size
    std::vector<Measured> front; ///< errors against times of those, fastest first
    std::optional<Measured> chosen; ///< none where nothing keeps the budget
    std::string nothing; ///< then: a sentence that names the nearest
    std::vector<std::string> reasons; ///< sentences
    std::vector<LeftOut> left_out;
    std::optional<Measured> best; ///< of all candidates at full size; only where exhaustive
    double regret = 0; ///< by which part the choice's error is above the best one's, or above one wrong pixel where that is more
};

/// Throws base::Error on names that do not exist and where no technique can run.
Advice advise(gpu::Device&, const AdviseOptions&);

/// Why, in sentences, from all else that an advice holds.
std::vector<std::string> advice_reasons(const Advice&);
/// The sentence for a budget that nothing keeps; something was measured.
std::string nothing_keeps(const Advice&);

nlohmann::ordered_json advice_json(const Advice&);
std::string advice_text(const Advice&); ///< for a terminal
std::string advice_page(const std::vector<Advice>&); ///< a table of choices, best ones and regrets, as Markdown

} // namespace gnomon::lab
