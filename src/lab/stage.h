// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/load.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::lab {

/// What a command line says about the picture to make.
struct StageOptions {
    std::string scene;
    scene::LoadOptions load;
    std::string camera; ///< scene::parse_camera; empty = the scene's first, else fitted
    std::vector<std::string> lights; ///< scene::parse_light each; empty = the scene's first of `kinds`, else a sun
    base::Size size{960, 540}; ///< pixels
    std::optional<vec3> origin; ///< Stage::origin; left out: scene::far_origin
    unsigned kinds = ~0u; ///< kinds of light (1 << LightKind) to choose from where none is named
};

/// A scene with one camera and its lights: everything of a picture but the technique.
struct Stage {
    std::string scene_name;
    vec3 origin{0}; ///< everything below is counted from here (scene/rebase.h); what people write and read is not
    scene::Scene scene;
    Bounds bounds;
    scene::Camera camera;
    std::vector<scene::Light> lights;
    scene::View view;
};

/// Throws base::Error on any part that does not exist or does not fit. The largest side allowed is 16384.
Stage open_stage(const StageOptions&);

/// Gives an opened stage the camera, lights and size of these options; their scene is taken to be the stage's.
void aim_stage(Stage&, const StageOptions&);

/// Throws base::Error where the size is empty or absurd.
void check_size(base::Size);

/// "640x360". Throws base::Error.
base::Size parse_size(const std::string&);

} // namespace gnomon::lab
