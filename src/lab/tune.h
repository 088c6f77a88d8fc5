// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/preset.h"
#include "lab/stage.h"

#include <filesystem>
#include <string>
#include <vector>

// Parameters that make an error small on some scenes, found by search (docs/tune-and-advise.md).
namespace gnomon::lab {

struct TuneOptions {
    std::string technique; ///< parse_choice: where the search begins, and what ratios are against
    std::vector<std::string> vary; ///< parameters to search; empty = all that `technique` does not set
    std::vector<StageOptions> tuning,
        validation; ///< the first light of each counts; tuning takes scenes that say `tuning`, validation those that say `validation`
    std::string minimise = "leak+acne,mae"; ///< parse_terms
    std::vector<std::string> under; ///< parse_constraint
    std::string reference; ///< of filter metrics
    int budget = 100; ///< evaluations, each of all tuning places
    uint64_t seed = 1;
    int truth_samples = 64;
    std::filesystem::path preset; ///< written whenever a better setting is known, or, with validation, at the end if it gains there
                                  ///< too; beside it, .runs.jsonl keeps every measurement
    std::filesystem::path truth_cache; ///< empty = the user's cache
};

struct Tuned {
    Preset preset;
    bool improved = false; ///< where it searched
    bool written = false; ///< validation, if there is any, gained (Ratios::gained)
    size_t measured = 0, kept = 0; ///< runs made now, and those that were found in the file of an earlier call
};

/// Throws base::Error, before anything is measured where a name is wrong, and at the end where no setting keeps the constraints: the
/// sentence names the nearest. An interrupted search goes on from its measurements when called again.
Tuned tune(gpu::Device&, const TuneOptions&);
std::string tune_text(const Tuned&); ///< for a terminal

/// Names in the text of a choice that it sets: "pcf:kernel=5" sets kernel.
std::vector<std::string> set_names(const std::string& choice);

} // namespace gnomon::lab
