// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"
#include "scene/view.h"

#include <optional>
#include <string>

namespace gnomon::lab {

/// What moves through a short sequence of frames, and how far in each. docs/results.md, "Sequences".
struct Motion {
    enum class Kind { still, camera, light, time };
    Kind kind = Kind::still;
    int frames = 8;
    std::optional<vec3> shift; ///< camera: metres right, up, forward a frame; light: metres along the world's axes
    std::optional<vec2> turn; ///< camera: degrees to the right and up a frame; light: of azimuth and elevation
    std::optional<double> step; ///< time: seconds of the scene's animation
};

inline constexpr int most_frames = 64;

/// still | camera,right=..,up=..,forward=..,turn=..,tilt=.. | light,azimuth=..,elevation=..  or  x=..,y=..,z=.. | time,step=..; each takes
/// frames=3..64. Steps that are left out are 0; where all are, `with_steps` chooses. Throws base::Error listing the near names or the
/// range.
Motion parse_motion(const std::string& text);
std::string motion_text(const Motion&); ///< what parse_motion reads, with the steps that are not 0

/// A step where none was given: two pixels sideways for the camera, half a degree for suns, a hundredth of the scene's radius for other
/// lights, a thirtieth of a second. `pixel`: its width in metres at the middle of the first frame. Throws base::Error where a light cannot
/// move so.
Motion with_steps(Motion, const scene::Light&, float pixel, float scene_radius);

/// In frame `index`, the first being 0.
scene::Camera moved(const scene::Camera&, const Motion&, int index);
scene::Light moved(const scene::Light&, const Motion&, int index);

} // namespace gnomon::lab
