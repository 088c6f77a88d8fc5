// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "scene/crop.h"

namespace gnomon::lab {

/// Puts the drawn part of a picture into its place in `whole`, a picture of `size`; times and counts are added up.
void paste(Rendered& whole, base::Size size, const Rendered& part, const scene::Crop&);

} // namespace gnomon::lab
