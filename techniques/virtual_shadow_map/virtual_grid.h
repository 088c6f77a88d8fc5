// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

#include "scene/light.h"
#include "scene/view.h"

namespace gnomon::techniques::virtual_shadow_map {

/// Texels around a page, for a filter of n x n taps.
int filter_border(const Params&);

/// The virtual maps of a light. Faces depend on the light and, in powers of two, on the scene's bounds, never on the view: pages drawn for
/// one view serve the next. Only the windows of a directional light's levels follow the view.
Grid fit_grid(const scene::View&, const Bounds&, const scene::Light&, const Params&, int pool);

/// Whether pages of `a` are pages of `b`.
bool same_pages(const Grid& a, const Grid& b);

} // namespace gnomon::techniques::virtual_shadow_map
