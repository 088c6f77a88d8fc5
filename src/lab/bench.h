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
    std::string reference = "shadow_map:map_size=2048"; ///< what every technique's own passes are divided by
    int repeats = 10;
};

/// One technique: milliseconds of the G-buffer and of its own passes. Their sum as ratios to Embree's time for the same primary and shadow
/// rays on all cores of this machine: tracing alone, and with the build of its tree, which a scene that moves needs. Its own passes as a
/// ratio to those of the reference, measured before and after it. All in this run.
struct BenchRow {
    std::string technique, skipped;
    double gbuffer_ms = 0, gbuffer_deviation = 0, technique_ms = 0, technique_deviation = 0;
    double ratio = 0, dynamic_ratio = 0, reference_ratio = 0; ///< the last: 0 where the reference does not take the light
    std::vector<PassStats> passes;
    std::map<std::string, uint64_t> counts; ///< what it counts of its work
};

struct Bench {
    std::string device, driver, scene, light, reference;
    base::Size size;
    size_t triangles = 0;
    double embree_packets_ms = 0; ///< traversal alone, packets, best of three
    double truth_ms = 0; ///< truth's own primary + visibility, wall time, best of three
    double bvh_ms = 0; ///< Embree's build
    double reference_ms = 0; ///< the reference's own passes, mean of all its measurements
    std::vector<BenchRow> rows;
};

/// Interleaves the techniques', the reference's and Embree's measurements, so that a busy machine slows all.
Bench bench(gpu::Device&, const BenchOptions&);
std::string bench_table(const Bench&);
nlohmann::ordered_json bench_json(const Bench&);

} // namespace gnomon::lab
