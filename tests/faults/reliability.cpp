// SPDX-License-Identifier: Apache-2.0
#include "reliability.h"

#include "base/file.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <sys/file.h>
#include <unistd.h>

namespace gnomon::tests {

namespace fs = std::filesystem;

std::optional<fs::path> results_folder()
{
    const char* folder = std::getenv("GNOMON_RELIABILITY");
    if (!folder || !*folder) return {};
    return fs::path(folder);
}

uint64_t step_of(uint64_t places, uint64_t short_runs)
{
    const char* step = std::getenv("GNOMON_RELIABILITY_STEP");
    if (at_full_length()) return step ? std::max<uint64_t>(1, std::strtoull(step, nullptr, 10)) : 1;
    return std::max<uint64_t>(1, places / short_runs);
}

void record(const std::string& file, const nlohmann::ordered_json& row)
{
    const std::optional<fs::path> folder = results_folder();
    if (!folder) return;
    const fs::path path = *folder / (file + ".json");
    const int lock = ::open(folder->c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); // two programs write at once
    if (lock < 0 || ::flock(lock, LOCK_EX) != 0) throw std::runtime_error("cannot lock " + folder->string());
    nlohmann::ordered_json json = {{"rows", nlohmann::ordered_json::array()}};
    if (fs::exists(path)) json = nlohmann::ordered_json::parse(base::read_text(path));
    json["rows"].push_back(row);
    base::write_text(path, json.dump(1) + "\n");
    ::close(lock);
}

} // namespace gnomon::tests
