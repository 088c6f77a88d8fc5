// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/stage.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace gnomon::lab {

/// What of a scene, a view and a light decides which shadows suit.
struct Features {
    size_t triangles = 0, masked = 0, see_through = 0; ///< as placed; of masked materials, of blended or transmissive ones
    size_t meshes = 0, open_meshes = 0; ///< open: an edge that has no second triangle
    scene::LightKind light = scene::LightKind::directional;
    bool soft = false, textured = false; ///< of the light
    double penumbra_pixels = 0; ///< estimated mean width; 0 where nothing is seen
    double shadowed = 0; ///< fraction of what is seen
    bool moves = false; ///< the model has another form a moment later
};

/// Of the stage's first light. The penumbra is taken from a picture of a quarter of the size with 16 light samples a pixel, traced by the
/// CPU. `options` are those of the stage: an animated file is read once more at a later time.
Features find_features(const Stage&, const StageOptions& options);

/// A mesh with an edge that only one triangle has; corners at one position are one.
bool is_open(const scene::Mesh&);

std::vector<std::string> feature_sentences(const Features&);
nlohmann::ordered_json features_json(const Features&);

} // namespace gnomon::lab
