// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace gnomon::truth {

/// A mesh with its material: what a ray needs to know at a hit. Given to Embree as the user pointer of each geometry.
struct Surface {
    const scene::Scene* scene = nullptr;
    const scene::Mesh* mesh = nullptr;
    const scene::Material* material = nullptr;
};

/// A texture at `uv`, colours decoded to linear before filtering, as a GPU samples mip level 0: texel centres at +0.5, the two
/// nearest texels each way wrapped one by one.
vec4 sample(const scene::Texture&, vec2 uv);

/// Base colour times texture times vertex colour at the barycentrics (u of the second corner, v of the third).
vec4 base_color(const Surface&, uint32_t triangle, float u, float v);

/// The alpha of the same, without decoding colours: what the cutoff is held against.
float alpha(const Surface&, uint32_t triangle, float u, float v);

} // namespace gnomon::truth
