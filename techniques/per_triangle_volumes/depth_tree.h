// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

namespace gnomon::techniques::per_triangle_volumes {

/// Over a picture of samples. Throws Error where it is larger than any tree.
shaders::Tree make_tree(base::Size samples);

} // namespace gnomon::techniques::per_triangle_volumes
