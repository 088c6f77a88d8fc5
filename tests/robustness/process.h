// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

// Runs the built program as a user does.
namespace gnomon::tests {

struct RunOptions {
    std::map<std::string, std::string> environment; ///< beyond the test's own
    uint64_t memory = 0; ///< bytes of address space; 0 = no limit
    double seconds = 60; ///< then it is killed: generous, because tests share the machine
    std::function<bool()> kill_when; ///< asked every millisecond; it gets the signal below when true
    int signal = 9;
};

struct Finished {
    int code = -1; ///< exit status; -1 where a signal ended it
    int signal = 0;
    bool timed_out = false;
    double seconds = 0;
    uint64_t peak_memory = 0; ///< bytes resident
    std::string out, err;
};

/// Runs `gnomon` with these arguments in `folder`, which becomes its home for caches too.
Finished run_gnomon(const std::vector<std::string>& arguments, const std::filesystem::path& folder, const RunOptions& = {});

/// A folder of its own for one test, deleted at the end.
class Scratch {
public:
    Scratch();
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const std::filesystem::path& folder() const { return folder_; }
    std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

private:
    std::filesystem::path folder_;
};

std::string read_whole(const std::filesystem::path&);

/// Fails unless the program ended with `code`, printed nothing, and said one line beginning "gnomon: " that holds all of `words`.
void expect_sentence(const Finished&, int code, const std::vector<std::string>& words);

} // namespace gnomon::tests
