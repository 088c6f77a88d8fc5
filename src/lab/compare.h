// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "truth/truth.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gnomon::lab {

struct CompareOptions {
    StageOptions stage;
    std::vector<std::string> techniques; ///< parse_choice
    std::string reference; ///< parse_choice: the technique that filtering is measured against; empty = none
    int truth_samples = 256;
    int repeats = 3; ///< timed frames after one warm-up
    std::string motion; ///< parse_motion: how the error changes along such a sequence is measured too; empty = it is not
    uint32_t frame_index = 0;
    std::filesystem::path folder; ///< where pictures and results.json go; empty = none are written
    std::filesystem::path truth_cache; ///< empty = the user's cache
};

/// Files in the folder of a comparison: "lit", "visibility" and, of techniques, "error".
using Pictures = std::map<std::string, std::string>;

/// How a technique did along a sequence (docs/results.md, "Sequences").
struct SequenceNumbers {
    std::string motion; ///< motion_text; empty = none was made
    std::vector<double> mae; ///< of each frame
    std::vector<double> change; ///< of each frame after the first: mean change of the error
    size_t followed = 0, lost = 0, moved = 0; ///< metrics::Temporal
};

/// One technique under one light, measured against truth. docs/results.md describes its JSON.
struct Run {
    std::string technique, scene, camera, light;
    std::string name; ///< choice_text
    truth::Quantity quantity = truth::Quantity::visibility; ///< of the truth that judges it
    Pictures pictures;
    base::Size size;
    std::string params; ///< JSON text
    std::vector<PassStats> passes;
    double technique_ms = 0, technique_deviation = 0;
    double technique_least_ms = 0; ///< of the timed frames
    uint64_t bytes = 0;
    std::map<std::string, uint64_t> counts; ///< of its work, by name; empty where it counts none
    std::map<std::string, double> metrics;
    std::string reference; ///< the choice behind the filter metrics; empty = they were not measured
    std::string reference_refused; ///< why, although one was given
    size_t excluded_pixels = 0; ///< raster and rays see different surfaces there
    size_t scored_pixels = 0;
    int truth_samples = 0;
    SequenceNumbers sequence;
    double truth_noise = 0; ///< RMS standard error of the truth
    std::string skipped; ///< the reason why this technique did not run here; the rest is then empty
};

/// What the runs under one light are judged by.
struct TruthPictures {
    std::string light;
    truth::Quantity quantity;
    Pictures pictures;
};

struct Comparison {
    std::string device, driver, commit;
    std::vector<Run> runs;
    std::vector<TruthPictures> truths;
    std::vector<std::filesystem::path> files; ///< written: pictures, results.json, results.csv, index.html last
};

/// Renders, traces, measures and writes. Techniques that refuse the device or the light are listed as skipped; if every one is,
/// base::Error.
Comparison compare(gpu::Device&, const CompareOptions&);

/// A run of this technique on this stage, not measured yet.
Run new_run(const Stage&, const Choice&, const std::string& light);
void add_times(Run&, const Rendered&); ///< passes, the technique's own time and memory

/// The truth that judges this kind of output. Only for visibility and transmittance.
truth::Quantity truth_quantity(const Choice&);

/// A technique's image as metrics take it: without the fourth channel of transmittance, which means nothing; and of one channel three times
/// that one where truth has three, because the technique takes a light with an image as uniform.
base::Picture judged_channels(const base::Picture& image, int truth_channels);

/// What `score` needs from render().
inline const std::set<std::string> scored_aovs = {"depth", "geometric_normal"};

/// The image of a reference technique for a stage's first light.
struct FilterReference {
    std::string choice; ///< as parse_choice reads it
    base::Picture image;
    std::string refused; ///< why this device or light has none; the image is then empty
};
FilterReference filter_reference(gpu::Device&, shadow::SceneGpu&, const Stage&, const std::string& choice);

struct ScoreOptions {
    const FilterReference* filter = nullptr; ///< adds the filter metrics, where its image has the technique's channels
    base::Picture* heat_map = nullptr;
    std::vector<uint8_t>* edge_band = nullptr; ///< kept between scores of one stage and light: empty before the first
};

/// 1 where raster and rays see the same surface, as `score` says. `excluded`: the others are added to it.
std::vector<uint8_t> score_mask(const truth::Primary&, const Rendered&, size_t* excluded = nullptr);

/// Measures one technique's first image against the truth of its light. Scored are the pixels where raster and rays see the same
/// surface: the same primitive, or coincident ones (depth within 1e-4 of its value, normals within 1 degree: a wall modelled twice,
/// the two triangles of a quad at their shared edge). The others are counted as excluded.
/// For hard lights `wrong_outside_band` counts wrong pixels with no true edge within half a pixel: the truth is traced again at
/// the corners and edge centres of the pixels and close to their centres; receivers whose plane holds the light to within 1e-3 radians
/// count as edges (their orientation is decided by the last bits).
void score(const Stage&, const scene::Light&, const truth::Reference&, const Rendered&, Run& out, const ScoreOptions& = {});

/// "" or why this technique has no image on this device and for this light that truth can judge.
std::string unmeasurable(const Choice&, const gpu::Device&, const scene::Light&);

nlohmann::ordered_json run_json(const Run&);
nlohmann::ordered_json results_json(const Comparison&);
std::string results_table(const Comparison&); ///< for a terminal
std::string results_csv(const Comparison&); ///< a line a run: who, where, metrics, times, bytes

/// A page that holds numbers, plots and pictures of a comparison whose pictures are in `folder`, as one file to be opened from disk.
/// Draws the plots there, error over time for each light, with its front (what nothing else beats in both).
std::string report_page(const Comparison&, const std::filesystem::path& folder);

/// The commit this program was built from, "unknown" outside a checkout.
std::string_view commit();

} // namespace gnomon::lab
