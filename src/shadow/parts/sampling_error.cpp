// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/sampling_error.h"

#include "shadow/parts/warp_parameter.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

double tangents(const Frustum& f) { return 2.0 * std::tan(f.half_fov); }

/// The frustum of each of `count` parts at logarithmic splits, as seen by the first.
Frustum first_part(const Frustum& f, double count)
{
    Frustum part = f;
    part.far = f.near * std::pow(f.ratio(), 1.0 / count);
    return part;
}

} // namespace

Error overhead_error(const Frustum& f, double n, double z)
{
    const double far = n + f.depth(), v = n + z - f.near;
    // v^2 / (far n) and v / far tend to 1
    const double t = std::isinf(n) ? 1.0 : v * v / (far * n), s = std::isinf(n) ? 1.0 : v / far;
    return {t * f.depth() / (tangents(f) * z), s * f.far / z};
}

Error overhead_largest(const Frustum& f, double n)
{
    const double far = n + f.depth(), scale = f.depth() / tangents(f);
    if (std::isinf(n)) return {scale / f.near, f.ratio()};
    const double t = n <= optimal_near(f.near, f.far, f.depth()) ? far / (n * f.far) : n / (far * f.near);
    return {scale * t, n * f.far / (f.near * far)};
}

double overhead_storage(const Frustum& f, double n) { return storage(overhead_largest(f, n)); }

double overhead_side_ratio(const Frustum& f, double n)
{
    const Error largest = overhead_largest(f, n);
    return largest.t / largest.s;
}

double logarithmic_t(const Frustum& f, double z) { return std::log(z / f.near) / std::log(f.ratio()); }

Error logarithmic_error(const Frustum& f) { return {std::log(f.ratio()) / tangents(f), 1.0}; }

double logarithmic_storage(const Frustum& f) { return storage(logarithmic_error(f)); }

double logarithmic_spacing(const Frustum& f, double z) { return z * std::log(f.ratio()); }

double plane_optimal_spacing(const Frustum& f, double z) { return z * z * (1.0 / f.near - 1.0 / f.far); }

double partitioned_storage_uniform(const Frustum& f, double count) { return count * overhead_storage(first_part(f, count), no_warp); }

double partitioned_storage_warped(const Frustum& f, double count)
{
    const Frustum part = first_part(f, count);
    return count * overhead_storage(part, optimal_near(part.near, part.far, part.depth()));
}

double partitioned_storage_behind(const Frustum& f, double count)
{
    // a map as wide and high as the far plane, one texel a pixel on the near plane
    const double ratio = first_part(f, count).ratio();
    return count * ratio * ratio;
}

double face_storage_behind(const Frustum& f, double cuts)
{
    // A side face is half a screen high at depth 1: (4.23) with tan(th) z for z, over 2 tan(th). The near face takes a texel a pixel.
    return 4.0 * cuts * 0.5 * (first_part(f, cuts).ratio() - 1.0) + 1.0;
}

Error partitioned_error(const Frustum& f, const std::vector<double>& ends, Warp warp, double z)
{
    size_t i = 0;
    while (i + 1 < ends.size() && z > ends[i]) ++i;
    Frustum part = f;
    part.near = i == 0 ? f.near : ends[i - 1], part.far = ends[i];
    const double n = warp == Warp::none ? no_warp : warp == Warp::view ? part.near : optimal_near(part.near, part.far, part.depth());
    return overhead_error(part, n, z);
}

} // namespace gnomon::shadow::parts
