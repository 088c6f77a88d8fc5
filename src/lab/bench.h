// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace gnomon::lab {

struct BenchOptions {
    StageOptions stage; ///< the first light is used, taken as hard
    std::vector<std::string> techniques;
    int repeats = 10;
};

/// One technique: milliseconds of the G-buffer and of its own passes, and their sum as a ratio to Embree's time for the same primary
/// and shadow rays on all cores of this machine, in this run.
struct BenchRow {
    std::string technique, skipped;
    double gbuffer_ms = 0, gbuffer_deviation = 0, technique_ms = 0, technique_deviation = 0, ratio = 0;
    std::vector<PassStats> passes;
};

struct Bench {
    std::string device, driver, scene, light;
    base::Size size;
    size_t triangles = 0;
    double embree_packets_ms = 0; ///< traversal alone, packets, best of three
    double truth_ms = 0; ///< truth's own primary + visibility, wall time, best of three
    double bvh_ms = 0; ///< Embree's build, not in the ratios
    std::vector<BenchRow> rows;
};

/// Interleaves the techniques' and Embree's measurements, so that a busy machine slows both.
Bench bench(gpu::Device&, const BenchOptions&);
std::string bench_table(const Bench&);
nlohmann::ordered_json bench_json(const Bench&);

} // namespace gnomon::lab
