// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/gbuffer.h"
#include "shadow/parts/light_map.h"

// The exact sampling error of a light map at a surface: how far one texel reaches in the picture (Eisemann, Schwarz, Assarsson, Wimmer
// 2011, "Real-Time Shadows", 3.2), measured on the map that is drawn. Projections of the map and the picture are both linear about a point,
// so that everything follows from the two matrices: no differences between pixels, which go wrong across edges.
namespace gnomon::shadow::parts {

/// The Jacobian (3.2), pixels per texel: column 0 is the edge of a texel along the map's u, column 1 along v.
///
/// `total` is that on the surface. With unit vectors v to the eye and l to the light, and P, Q the derivatives of pixel and texel by the
/// point, it is P B (Q B)^-1 for any basis B of the surface. A texel's beam has the cross-section (Q L)^-1 across l, a pixel's (P V)^-1
/// across v, and the surface cuts both: its area is the cross-section's over the cosine of psi_t or psi_j, the angles between its normal
/// and the beams. So det(total) = det(P V (Q L)^-1) * cos(psi_j) / cos(psi_t), the split of (3.11).
///
/// `perspective` = P V (Q L)^-1 is therefore the error of a surface that both beams meet at one angle, with V and L the bases that such a
/// surface takes into each other: v x l, and what it makes with v or l (the rotation by the shortest way from l to v). It does not
/// depend on the surface. `projection` is the quotient of the cosines: large where the light grazes what the eye sees squarely.
struct TexelFootprint {
    glm::dmat2 total, perspective;
    double projection;
};

/// At `p` on a surface with unit normal n, in a layer of `size` texels a side that is a projection (no paraboloid). Infinite where the
/// surface holds the light's direction.
TexelFootprint texel_footprint(const shaders::LightMapLayer&, double size, const scene::View&, glm::dvec3 p, glm::dvec3 n);

/// The longer edge of a texel, pixels: 1 matches, more is undersampled. No edge of a texel is longer.
double longer_edge(const glm::dmat2&);

/// For each pixel (rgba32f): the longer edge of `total`, of `perspective`, and `projection`; 0 where the map is not looked at: background,
/// surfaces turned away from the light, and what lies outside of the map.
void draw_texel_footprint(gpu::PassList&, const GBuffer&, const scene::View&, const LightMap&, gpu::ImageId out);

} // namespace gnomon::shadow::parts
