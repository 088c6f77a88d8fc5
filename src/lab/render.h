// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "lab/stage.h"
#include "shadow/lighting.h"
#include "shadow/technique.h"

#include <functional>
#include <map>
#include <set>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace gnomon::lab {

/// A technique with its parameters.
struct Choice {
    const shadow::TechniqueInfo* info;
    shadow::ParamValues params;
};
Choice default_choice(const shadow::TechniqueInfo&);
/// "pcss", "pcss:light_radius=0.2:filter_taps=16", or "@pcss.json", a preset's file, which parameters may follow too. Throws base::Error.
Choice parse_choice(const std::string& text);
std::string choice_text(const Choice&); ///< what parse_choice reads: the id, and the parameters that differ from their defaults

shadow::Output output_of(const Choice&);

/// Statistics of one pass over the repetitions.
struct PassStats {
    std::string name;
    double ms, deviation; ///< mean and standard deviation
    int count = 1; ///< passes of that name in a frame, whose times are added up
};

/// Asked before each timed frame but the first: how many there are, and the least of the technique's own times among them.
using Again = std::function<bool(int frames, double least_ms)>;

struct RenderSettings {
    int samples = 1; ///< supersampling: pictures averaged, jittered by a Halton sequence; each has a frame number of its own
    int repeats = 1; ///< timed repetitions of the first sample, after one warm-up when more than one
    int warm_up = 0; ///< frames before the timed ones; one at least where there is more than one repetition
    uint32_t frame_index = 0;
    Again again; ///< where given, says how many frames are timed, instead of `repeats`
    bool count = false; ///< one more frame, in which a technique that can counts its work
    int tile = 4096; ///< pixels: pictures with a longer side are drawn in parts of at most so many each way, one after the other
    bool lit = true; ///< shade; otherwise only the techniques' images are made
    std::set<std::string> aovs; ///< aov_names()
    shadow::LightingSettings lighting;
    std::stop_token stop{}; ///< where it is asked for, `render` ends after the frame in hand, with base::Error
};
const std::vector<std::string>& aov_names(); ///< visibility, depth, normal, geometric_normal, albedo, surface, primitive, position, motion,
                                             ///< and texel_footprint, texel_footprint_perspective, texel_footprint_projection

struct Rendered {
    base::Picture radiance; ///< RGB, scene-referred linear; empty unless lit
    std::vector<base::Picture> images; ///< the technique's image for each light, of the first sample
    std::vector<uint32_t> primitive; ///< of the first sample
    std::map<std::string, base::Picture> aovs; ///< of the first sample
    std::vector<PassStats> passes; ///< common and technique's, in order; the technique's begin with its id and "/"
    double technique_ms = 0, technique_deviation = 0; ///< its own passes, all lights together
    double technique_least_ms = 0; ///< of the timed frames
    std::map<std::string, uint64_t> counts; ///< shadow::Counter by name, all lights together; empty unless asked for
    uint64_t technique_bytes = 0; ///< transients beyond the common ones and the images of the contract
};

/// Draws a stage with one technique for all its lights. A picture in parts is what it is in one piece, but for what a technique fits to
/// what the view sees: its maps are then fitted to each part, and times are those of all parts together. `scene` is the stage's scene on
/// the device. Throws base::Error with the technique's reason where it refuses the device or a light.
Rendered render(gpu::Device&, shadow::SceneGpu& scene, const Stage&, const Choice&, const RenderSettings&);

/// One technique object through frames that differ in nothing but the camera: images, primitives and aovs of each, neither lit nor timed.
/// Frame numbers count up from `settings.frame_index`; `settings.warm_up` frames of the first camera go before.
std::vector<Rendered> render_sequence(
    gpu::Device&, shadow::SceneGpu& scene, const Stage&, const Choice&, std::span<const scene::Camera>, RenderSettings settings);

/// Shades with given images (visibility or transmittance, one a light) instead of a technique's: the lit picture of the truth.
base::Picture shade_with(
    gpu::Device&, shadow::SceneGpu& scene, const Stage&, const std::vector<base::Picture>& images, const shadow::LightingSettings&);

/// Scene-referred radiance to display-referred linear RGB in [0, 1]: exposure so that a white diffuse surface under the stage's
/// strongest light comes out near white, then the Khronos PBR Neutral tone curve. `stops` is added to the exposure.
base::Picture display(const base::Picture& radiance, const Stage&, float stops = 0.0f);

} // namespace gnomon::lab
