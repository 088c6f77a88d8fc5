// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"
#include "scene/math.h"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

using base::Size;

/// A pinhole or orthographic camera.
struct Camera {
    std::string name;
    vec3 eye{0, 1, 5}, target{0, 0, 0}, up{0, 1, 0};
    float fov_y = 0.872665f; ///< radians, full vertical angle; perspective only
    float half_height = 0.0f; ///< metres; > 0 makes the camera orthographic
    float near = 0.0f; ///< metres; 0 = chosen from the scene's size (make_view)
};

/// A camera at work: its matrices for one picture size. Depth is reversed: 1 at the near plane, 0 at infinity (perspective) or at
/// `far` (orthographic). Clip space is Vulkan's: y down, z in [0, 1]. docs/conventions.md.
struct View {
    mat4 view_from_world{1}, clip_from_view{1}, clip_from_world{1}, world_from_clip{1};
    vec3 eye{0};
    float near = 0.1f;
    bool orthographic = false;
    Size size;
};

/// `jitter` moves the picture by a fraction of a pixel (right, down), for supersampling. Throws Error on a camera whose eye is its
/// target or whose numbers are not finite.
View make_view(const Camera&, Size, const Bounds& scene_bounds, vec2 jitter = vec2(0));

/// The ray through a pixel position (pixel centres at +0.5): origin on the near plane's eye side and unit direction, world space.
struct Ray {
    vec3 origin, direction;
};
Ray view_ray(const View&, vec2 pixel);

/// A camera that sees all of `bounds`, from a three-quarter view slightly above.
Camera fit_camera(const Bounds& bounds);

/// A camera from the command line: a name (or unique part of one) in `known`, "fit", or key=value pairs after it:
/// eye=1/2/3,target=0/0/0,up=0/1/0,fov=50 (degrees),near=0.1,ortho=5 (half height, metres). Throws Error listing the near names.
Camera parse_camera(std::string_view text, const std::vector<Camera>& known, const Bounds& bounds);

} // namespace gnomon::scene
