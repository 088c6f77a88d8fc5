// SPDX-License-Identifier: Apache-2.0
#pragma once

// How strongly a light map is warped: the distance n of the near plane of the warping frustum, whose axis lies in the map's plane along
// the view (Wimmer, Scherzer, Purgathofer 2004, "Light space perspective shadow maps"; Eisemann, Schwarz, Assarsson, Wimmer 2011,
// "Real-Time Shadows", 4.2.2, whose equations are numbered here). Infinity is no warp. Along a line of the map's plane that leads away from
// the eye, depth in the view grows from z0 to z1 while the line advances by `extent`, that is from the frustum's near plane n to its
// far plane n + extent. All in double precision, and in the unit of the arguments.
namespace gnomon::shadow::parts {

/// (4.16): the error along the map's second axis is equal at both ends, and nowhere on the line larger.
double optimal_near(double z0, double z1, double extent);

/// How much of that warp a light bears whose direction makes `gamma` with the view's axis (radians, either way round), in a view of
/// `half_fov`: -1, none, to 0, all. Where the light is closer to the axis than half a field of view, a side of the frustum turns edge-on to
/// it, and the errors that (4.16) does not see grow faster than (4.17), the sine of gamma, makes the warp fall off: 2.5 times those of
/// no warp. The curve of Lloyd 2007, "Logarithmic perspective shadow maps", 5.1.2.1 and 5.2.1.
/// Differs from the paper: its last piece, up to 0.3 of the way from half_fov to a right angle, is a sine.
double falloff(double gamma, double half_fov);

/// The near plane at Lloyd's normalised parameter: -1 no warp, 0 (4.16), 1 the view's own perspective (Stamminger, Drettakis 2002).
double near_from_eta(double eta, double z0, double z1, double extent);

/// The near plane where errors count only at depths `from` to `to` of the view (a pseudo near and far plane, 4.2.2). The square root form
/// equals (4.16) where the two hold the whole line. What is closer than `from` still has shadows, of coarser texels.
/// Far pseudo near planes, d = from - z0, have the least storage factor at d / (2 - 3 d / (z1 - z0)), and none at all from 2/3 of the way.
double pseudo_near(double z0, double z1, double extent, double from, double to);

/// The near plane that gives the first `focus` of the line a share of the map (Martin, Tan 2004, "Anti-aliasing and continuity with
/// trapezoidal shadow maps", whose share is 0.8).
double trapezoid_near(double focus, double extent, double share);

struct WarpLine {
    double z0, z1, extent;
    double from, to; ///< depths that count; z0 and z1 where all do
};

/// The weaker warp of what the tilt bears and what the depths ask for.
double warp_near(const WarpLine&, double gamma, double half_fov);

} // namespace gnomon::shadow::parts
