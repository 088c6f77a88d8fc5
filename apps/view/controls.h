// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"
#include "scene/view.h"

// How the mouse and keys move cameras and lights. Pure functions; angles in radians, x to the right and y down as the mouse moves.
namespace gnomon::view {

scene::Camera orbit(scene::Camera, vec2 turn); ///< the eye around the target
scene::Camera look(scene::Camera, vec2 turn); ///< the target around the eye
scene::Camera slide(scene::Camera, vec2 pixels, float picture_height); ///< both across the view, so that the target stays under the mouse
scene::Camera approach(scene::Camera, float steps); ///< > 0: nearer to the target; orthographic: a smaller window
scene::Camera fly(scene::Camera, vec3 metres); ///< both: right, up, forward

/// Turns a directional light; moves all others across the view, or along it.
scene::Light drag_light(scene::Light, const scene::Camera&, vec2 pixels, float picture_height, bool along);

/// Makes it larger (pixels > 0) or smaller, by a factor for each pixel, and from a point to something at all. `unit`: metres that are small
/// in the scene.
scene::Light resize_light(scene::Light, float pixels, float unit);

} // namespace gnomon::view
