// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "lab/stage.h"

#include <string>
#include <vector>

// What is seen, as the words of a command line. The session keeps cameras and lights as what these texts are read back as, so that a
// copied command line gives the very same bits.
namespace gnomon::view {

/// What scene::parse_camera reads: eye=..,target=..,fov=.. Cameras and lights are counted from `origin` (scene/rebase.h), texts are not.
std::string camera_text(const scene::Camera&, vec3 origin = vec3(0));

/// Where a light began: a kind, or a light of the scene by its name, which then keeps what no key can say (how a rectangle is turned).
struct LightOrigin {
    std::string base; ///< kind or name
    std::string image; ///< as image= was given; "" = none
    bool known = false; ///< a name
    vec3 color{1}; ///< what it has without a colour of its own
};
LightOrigin light_origin(const std::string& option, const std::vector<scene::Light>& known);
/// Of a light that was chosen for want of an option.
LightOrigin light_origin(const scene::Light&, const std::vector<scene::Light>& known, const Bounds&, vec3 origin = vec3(0));

/// What scene::parse_light reads.
std::string light_text(const scene::Light&, const LightOrigin&, vec3 origin = vec3(0));

/// Quoted for a POSIX shell where it has to be.
std::string shell_word(const std::string&);

struct CommandLine {
    std::string scene;
    scene::LoadOptions load;
    std::string camera;
    std::vector<std::string> lights;
    base::Size size;
    float exposure = 0, ambient = 0.45f;
};
/// The `gnomon render` line that draws this.
std::string render_command(const CommandLine&, const lab::Choice&);

} // namespace gnomon::view
