// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

// A small experiment, and what sweeps of it leave behind.
namespace gnomon::tests {

using Json = nlohmann::ordered_json;

/// Six runs that take a moment each.
inline Json small()
{
    return {{"scene", "balls"}, {"light", "sun,elevation=50,azimuth=35,angle=0"}, {"size", "64x48"},
        {"axes", {{"kernel", {1, 3, 5}}, {"map_size", {64, 128}}}},
        {"techniques", {{{"technique", "shadow_map"}, {"params", {{"pcf", "$kernel"}, {"map_size", "$map_size"}}}}}},
        {"reference", {{"technique", "shadow_map"}, {"params", {{"pcf", 7}, {"map_size", "$map_size"}}}}},
        {"metrics", {"mae", "filter_leak"}}, {"repeats", 1}, {"plots", {{{"x", "kernel"}, {"y", "mae"}, {"series", "map_size"}}}}};
}

inline std::string write(const Scratch& scratch, const Json& json, const std::string& name = "small.json")
{
    std::ofstream(scratch / name) << json.dump(1);
    return name;
}

inline std::vector<std::string> lines_of(const std::filesystem::path& file)
{
    std::vector<std::string> lines;
    std::istringstream in(read_whole(file));
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

inline Json sweep(const Scratch& scratch, std::vector<std::string> more = {})
{
    std::vector<std::string> words = {"sweep", "small.json", "--json"};
    if (std::find(more.begin(), more.end(), "-o") == more.end()) words.insert(words.end(), {"-o", "out"});
    words.insert(words.end(), more.begin(), more.end());
    const Finished f = run_gnomon(words, scratch.folder());
    EXPECT_EQ(f.code, 0) << f.err;
    return Json::parse(f.out);
}

} // namespace gnomon::tests
