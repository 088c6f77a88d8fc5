// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/view.h"
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

namespace gnomon::techniques::per_triangle_volumes {

/// Over a view whose pixels are spread to so many samples across and down, powers of two. Throws Error where these are more than any tree
/// takes.
shaders::Tree make_tree(const scene::View&, uvec2 samples_a_pixel = uvec2(1));

} // namespace gnomon::techniques::per_triangle_volumes
