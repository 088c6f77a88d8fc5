// SPDX-License-Identifier: Apache-2.0
#include "lab/sweep.h"

#include "lab/compare.h"
#include "lab/folder.h"

#include <cctype>
#include <fstream>

namespace gnomon::lab {

namespace {

std::string processor()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos) return line.substr(line.find(": ") + 2);
    return "unknown";
}

} // namespace

Provenance provenance(const gpu::Device& device)
{
    return {device.info().name, device.info().driver, processor(), GNOMON_VERSION_TEXT, std::string(commit())};
}

std::filesystem::path default_results_folder(const std::string& device, const Experiment& experiment)
{
    std::string name;
    for (const char c : device.substr(0, device.find(" (")))
        name += std::isalnum(static_cast<unsigned char>(c)) ? char(std::tolower(static_cast<unsigned char>(c))) : '_';
    return project_root() / "experiments" / "results" / name / experiment.name;
}

} // namespace gnomon::lab
