// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/compare.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::lab {

struct MeterSettings {
    int truth_samples = 64;
    std::string reference; ///< parse_choice: what filter metrics are measured against; empty = none
    std::optional<truth::Quantity> quantity; ///< the truth that judges every technique; where left out, that of its own output
    std::filesystem::path truth_cache; ///< empty = the user's cache
};

/// Measures choices at places that stay: a scene is on the device once, and each place's truth is traced once.
class Meter {
public:
    Meter(gpu::Device&, MeterSettings);
    ~Meter();
    /// A place is one scene, camera, light and size; the first of the stage's lights counts. Throws base::Error.
    size_t add(const StageOptions&);
    size_t places() const;
    const Stage& stage(size_t place); ///< aimed at it, with one light; holds until another place is used
    std::string light_name(size_t place);
    std::string key(size_t place); ///< a hash of all that its truth follows from

    /// With one repeat, times hold the making of pipelines; `again` as in RenderSettings. Throws base::Error where the technique cannot run
    /// there.
    Run measure(size_t place, const Choice&, int repeats, const Again& again = {});
    /// A frame's time alone: neither truth nor metrics.
    Run measure_time(size_t place, const Choice&, int repeats, const Again& again = {});

private:
    struct Opened;
    struct Place;
    Place& aim(size_t place);
    gpu::Device& device_;
    MeterSettings settings_;
    std::map<std::string, std::unique_ptr<Opened>> scenes_;
    std::vector<std::unique_ptr<Place>> places_;
};

} // namespace gnomon::lab
