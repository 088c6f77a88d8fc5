// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "scene/math.h"

#include <cstdint>
#include <string>
#include <vector>

// Where filters look: tap patterns and the noise that turns them. The same numbers on every machine.
namespace gnomon::shadow::parts {

/// `count` points of the unit disk, none close to another, the outermost first.
std::vector<vec2> poisson_disk(int count);

/// Vogel's spiral (1979): turned by the golden angle from point to point, each with the same area; the outermost first.
std::vector<vec2> vogel_disk(int count);

/// The inverse of scene::square_to_disk, onto [-1, 1]^2: a disk's points as evenly over a square.
vec2 disk_to_square(vec2);

/// Names of the choices ROTATE_* of shaders/noise.glsl.
std::vector<std::string> rotations();
inline constexpr int rotate_blue_noise = 1;

/// Ulichney's void-and-cluster order (1993) of size x size pixels, which repeat: thresholding it at any level gives blue noise.
std::vector<uint32_t> void_and_cluster(int size);

/// void_and_cluster(64) as values in (0,1), R32F, for blue_noise of shaders/noise.glsl. Takes some 50 ms: make it when it is asked for.
gpu::Image blue_noise(gpu::Device&);

} // namespace gnomon::shadow::parts
