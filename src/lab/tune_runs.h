// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/line_file.h"
#include "lab/goal.h"
#include "lab/meter.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gnomon::lab {

/// The measurements of a search, of which a file keeps a line each: what it has is not measured again.
class TuneRuns {
public:
    struct Goal {
        std::vector<std::vector<std::string>> terms; ///< parse_terms
        std::vector<Constraint> under;
        std::string reference; ///< of filter metrics
    };
    struct Kept {
        std::map<std::string, double> values; ///< by quantity; nothing where the device cannot run it, bytes alone where those miss a bound
        std::map<std::string, double> reference; ///< the same of the search's start, measured just before; only what ratios need
    };

    /// `base` is the search's start. Throws base::Error where the file holds something else.
    TuneRuns(gpu::Device&, Meter&, const Choice& base, Goal, const std::filesystem::path& file);

    /// Of the file, else measured now. That `start` cannot run is an error.
    const Kept& at(const Choice&, size_t place, bool start);
    size_t measured() const { return measured_; }
    size_t from_file() const { return from_file_; }

    static double missed(const Constraint&, const Kept&); ///< missed_by
    static double ratio(double value, double by); ///< 1 where both are 0

private:
    void note(const std::string& quantity, bool relative);
    std::string key(const Choice&, size_t place);
    void take(const std::string& line);
    const Kept& record(const std::string& key, const Choice&, size_t place, Kept);
    bool bytes_bound() const;
    bool timed() const; ///< as a multiple of the start's
    /// What misses a bound of bytes is not measured further than one frame, since large maps take longest: `now` gets its bytes alone.
    bool too_large(const Choice&, size_t place, Kept& now);
    bool too_slow(const Kept&) const;

    gpu::Device& device_;
    Meter& meter_;
    const Choice& base_;
    Goal goal_;
    std::filesystem::path name_;
    base::LineFile file_;
    std::vector<std::string> quantities_, relative_;
    int repeats_ = 1;
    std::map<std::string, Kept> known_;
    std::set<std::string> of_file_; ///< keys not asked for yet
    std::vector<std::string> keys_; ///< of places
    size_t measured_ = 0, from_file_ = 0;
};

} // namespace gnomon::lab
