// SPDX-License-Identifier: Apache-2.0
#include "reliability.h"

#include "base/file.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sys/file.h>

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
    // two programs write at once; closing lets the other in
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> lock(std::fopen((*folder / ".lock").c_str(), "w"), &std::fclose);
    if (lock) ::flock(::fileno(lock.get()), LOCK_EX);
    nlohmann::ordered_json json = {{"rows", nlohmann::ordered_json::array()}};
    if (fs::exists(path)) json = nlohmann::ordered_json::parse(base::read_text(path));
    json["rows"].push_back(row);
    base::write_text(path, json.dump(1) + "\n");
}

} // namespace gnomon::tests
