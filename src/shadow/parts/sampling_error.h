// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

// Perspective error of light maps in closed form: how many pixels a texel covers, apart from how its surface is turned. Definitions and
// equations: Eisemann, Schwarz, Assarsson, Wimmer 2011, "Real-Time Shadows", chapters 3 and 4.2, after Lloyd, Tuft, Yoon, Manocha 2006,
// "Warping and partitioning for low error shadow maps", and Lloyd 2007; misprints are corrected (docs/error-analysis.md).
// All errors are normalised: pixels per texel of a map with as many texels as the picture has pixels, in each direction.
namespace gnomon::shadow::parts {

/// The part of a view that receives shadows.
struct Frustum {
    double near, far; ///< metres along the view's axis
    double half_fov; ///< radians, vertical
    double aspect = 1.0;
    double ratio() const { return far / near; }
    double depth() const { return far - near; }
};

/// Along the map's t axis, which follows the view's axis, and along s, which follows the picture's width. (3.11), (3.12)
struct Error {
    double t, s;
};

inline constexpr double no_warp = std::numeric_limits<double>::infinity();

/// Shadow texels a picture's pixel for which no texel covers more than a pixel, (3.15), from the largest errors.
inline double storage(Error largest) { return largest.t * largest.s; }

// A parallel light across the view's axis ("overhead") is warping's best case, and the one with closed forms. Errors are those on
// the view's axis; off it, t's are larger by 1 / cos(angle off the axis, vertically). `n`: near plane of the warp (no_warp: uniform; the
// view's near: perspective shadow maps); its far plane is n + far - near.

Error overhead_error(const Frustum&, double n, double z); ///< (4.19); uniform: its limit
Error overhead_largest(const Frustum&, double n); ///< over all z: (4.21), (4.22)
double overhead_storage(const Frustum&, double n); ///< (4.23), (4.25): level up to (4.18), then rising to `ratio` times as much
/// M_t / M_s, (4.24): the map's height over its width, in screens, that makes both largest errors equal.
double overhead_side_ratio(const Frustum&, double n);

/// The best of all parametrisations, of constant error: t is the logarithm of depth. (4.31), (4.35)
double logarithmic_t(const Frustum&, double z);
Error logarithmic_error(const Frustum&);
double logarithmic_storage(const Frustum&);

/// Metres along the view's axis that one unit of t covers at z: equal steps (uniform), steps that grow with z (logarithmic), or with
/// its square, for which texels on a plane below the eye are of one size in the picture.
double logarithmic_spacing(const Frustum&, double z);
double plane_optimal_spacing(const Frustum&, double z);

// Storage factors of `count` maps, one behind another at logarithmic splits, (4.38) to (4.40): each is like the first.
double partitioned_storage_uniform(const Frustum&, double count);
double partitioned_storage_warped(const Frustum&, double count);
/// The light shines along the view's axis: warping gains nothing.
double partitioned_storage_behind(const Frustum&, double count);
/// The same light, a warped map for each side face of the frustum and one for the near face, the side faces cut `cuts` times at
/// logarithmic splits: 4 cuts + 1 maps (Lloyd et al. 2006).
double face_storage_behind(const Frustum&, double cuts);

/// How a partition's map is warped.
enum class Warp { none, optimal, view };

/// Overhead light, one map of equal texels for each part between `near` and the ascending `ends`: the error at z. Each map is as wide as
/// its part.
Error partitioned_error(const Frustum&, const std::vector<double>& ends, Warp, double z);

/// A parallel light whose direction makes `gamma` with the view's axis, in the plane of the axis and the picture's vertical. What the
/// map's t axis spans, and, sampled densely in `steps`, the largest errors in the frustum, with each pixel's obliquity.
struct Span {
    double least, most; ///< metres along the axis that the view's becomes in the map
    double extent() const { return most - least; }
};
Span tilted_span(const Frustum&, double gamma);
Error tilted_largest(const Frustum&, double gamma, double n, int steps = 96);
/// The near plane of least storage factor, by search.
double tilted_best_near(const Frustum&, double gamma);
/// Near planes by (4.17) and with Lloyd's falloff.
double tilted_optimal_near(const Frustum&, double gamma);
double tilted_shaped_near(const Frustum&, double gamma);

} // namespace gnomon::shadow::parts
