// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/compare.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What lies beside a technique's code: its scene, its promise, its goldens, its page.
namespace gnomon::lab {

/// The root of a checkout (or of a bundle with tests): $GNOMON_ROOT, else the nearest parent of the working folder that holds
/// techniques/. Throws base::Error where there is none.
std::filesystem::path project_root();

/// techniques/<id>/scene.json: {"scene", "detail", "camera", "lights": {kind: light}, "params": {...}, "truth_samples",
/// "promise": {kind: {metric: bound}}, "reference", "golden_tolerance": {"pixels", "mean", "reason"}}. Unknown keys are errors.
struct TechniqueScene {
    std::string scene, camera;
    double detail = 1.0;
    std::map<std::string, std::string> lights; ///< by kind: what scene::parse_light reads
    std::string params = "{}"; ///< JSON
    int truth_samples = 256;
    std::string reference; ///< parse_choice: the technique behind the filter metrics; empty = none
    std::map<std::string, std::map<std::string, double>> promise; ///< by kind of light: metric -> largest value
    double golden_pixels = 0.001, golden_mean = 1.0 / 2550.0; ///< see compare_golden
};
TechniqueScene read_technique_scene(const std::filesystem::path& folder);

/// The stage of a technique's own scene under its light of one kind.
Stage technique_stage(const TechniqueScene&, const std::string& kind, base::Size);
Choice technique_choice(const shadow::TechniqueInfo&, const TechniqueScene&);
std::vector<std::string> claimed_kinds(const shadow::TechniqueInfo&);

inline constexpr base::Size golden_size{256, 256};
/// The image that a golden holds, 8 bits deep: one channel, or three.
base::Picture golden_image(gpu::Device&, const shadow::TechniqueInfo&, const std::string& kind, const std::filesystem::path& folder);

/// Goldens are made by lavapipe of one major release; elsewhere they say nothing. "" or the reason to skip them.
std::string golden_skip(const gpu::Device&);

struct GoldenDifference {
    bool same = true;
    size_t off_pixels = 0; ///< differ by more than 4/255 in a channel
    int largest = 0; ///< of 255
    double mean = 0; ///< of 1
    int worst_x = 0, worst_y = 0;
    std::string text; ///< four lines for a log
};
/// "Did it change?": fails when more than `pixels` of all are off by more than 4/255, the mean differs by more than `mean`, a value
/// is not finite or the sizes differ.
GoldenDifference compare_golden(const base::Picture& got, const base::Picture& golden, double pixels = 0.001, double mean = 1.0 / 2550.0);

/// A measured metric that is over what scene.json promises.
struct BrokenPromise {
    std::string kind, metric;
    double bound, measured;
};
struct PromiseReport {
    std::vector<Run> runs;
    std::vector<BrokenPromise> broken;
};
PromiseReport check_promises(gpu::Device&, const shadow::TechniqueInfo&, const std::filesystem::path& folder, base::Size size = {384, 256},
    const std::filesystem::path& truth_cache = {});

/// Copies techniques/_template to techniques/<id> with the names filled in; returns the files. Refuses ids that are not lower-case
/// names or that exist.
std::vector<std::filesystem::path> new_technique(const std::filesystem::path& root, const std::string& id);

/// Writes goldens of one technique on this device; a change needs a reason. Returns what changed, with the promises' metrics.
std::string bless(gpu::Device&, const shadow::TechniqueInfo&, const std::filesystem::path& folder, const std::string& because);

inline constexpr base::Size picture_panel{320, 240};
inline constexpr int picture_gap = 4;
/// Makes techniques/<id>/<id>.png: panels with gaps between them, the technique first, the truth, and the error with its legend below.
std::filesystem::path make_picture(gpu::Device&, const shadow::TechniqueInfo&, const std::filesystem::path& folder);

/// docs/pictures/<scene>.png of every built-in scene under its first light: ray_traced, or shadow_map where the device has no rays.
std::vector<std::filesystem::path> make_scene_pictures(gpu::Device&, const std::filesystem::path& root);

/// Rewrites the generated blocks (between `<!-- generated:NAME -->` and `<!-- /generated -->`) of the technique pages, of
/// techniques/README.md, of the README and of docs/gallery.md, and makes the thumbnails anew that are not of the present pictures; with
/// `check`, writes nothing. Returns the files that were stale. Parameter tables come from the code; cost and error from
/// techniques/<id>/results.json (made by `gnomon picture`).
std::vector<std::filesystem::path> update_docs(const std::filesystem::path& root, bool check);

/// A part of it: pages, tables and plots of sweeps below experiments/results whose line file (results.jsonl) is there. Left alone are
/// those whose experiment cannot be read here (its scenes are elsewhere) and whose runs are all of other parameters than today's.
std::vector<std::filesystem::path> update_result_pages(const std::filesystem::path& root, bool check);

} // namespace gnomon::lab
