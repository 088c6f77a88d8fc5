// SPDX-License-Identifier: Apache-2.0
#include "lab/curves.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/sampling_error.h"
#include "shadow/parts/warp_parameter.h"

#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <tuple>

namespace gnomon::lab {

namespace {

using namespace shadow::parts;

constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Near 1 and half a field of view of 30 degrees.
Frustum frustum(double ratio) { return {1.0, ratio, 30.0 * degree}; }
double best_near(const Frustum& f) { return optimal_near(f.near, f.far, f.depth()); }

std::vector<double> geometric(double from, double to, int count)
{
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(from * std::pow(to / from, double(i) / (count - 1)));
    return out;
}

void add(Curves& c, const std::string& name, size_t color, size_t dash, const std::function<double(double)>& y)
{
    Curve curve{name, color, dash, {}};
    for (const double x : c.x) curve.y.push_back(y(x));
    c.curves.push_back(curve);
}

Curves warps()
{
    const Frustum f = frustum(100);
    Curves c{"warps", "Error over depth of one map", "", "depth in the view / near plane", "pixels per texel", true, true,
        geometric(1, 100, 121), {}};
    c.text
        = "As figure 4.8 of Real-Time Shadows: an overhead light, far/near = 100. Without a warp both errors fall as 1/z. With the view's "
          "own perspective (n = near) s is perfect and all of the error is t's, at the far end. The optimal n makes t's error equal at "
          "both ends; the product of both maxima is the same.";
    const std::tuple<const char*, const char*, double> maps[]
        = {{"uniform, t", "uniform, s", no_warp}, {"n = near, t", "n = near, s", f.near}, {"optimal n, t", "optimal n, s", best_near(f)}};
    for (size_t i = 0; i < std::size(maps); ++i) {
        const auto& [t, s, near] = maps[i];
        const double n = near;
        add(c, t, i, 0, [&](double z) { return overhead_error(f, n, z).t; });
        add(c, s, i, 1, [&](double z) { return overhead_error(f, n, z).s; });
    }
    add(c, "logarithmic, t", 3, 0, [&](double) { return logarithmic_error(f).t; });
    add(c, "logarithmic, s", 3, 1, [&](double) { return logarithmic_error(f).s; });
    return c;
}

Curves spacing()
{
    const Frustum f = frustum(100);
    Curves c{"spacing", "How texels are spread over depth", "", "depth in the view / near plane",
        "length of 1/1000 of the map / near plane", true, true, geometric(1, 100, 121), {}};
    c.text
        = "As figure 4.9: all maps have the same number of texels. Texels that grow with z keep their size in the picture when they face "
          "the eye (logarithmic); those that grow with its square keep it on a floor below the eye (plane-optimal, the view's own "
          "perspective), and are far too long for all else that is distant.";
    add(c, "uniform", 0, 0, [&](double) { return 1e-3 * f.depth(); });
    add(c, "logarithmic", 3, 0, [&](double z) { return 1e-3 * logarithmic_spacing(f, z); });
    add(c, "plane-optimal", 1, 0, [&](double z) { return 1e-3 * plane_optimal_spacing(f, z); });
    add(c, "optimal n", 2, 0, [&](double z) { return 1e-3 * z * 2.0 * std::tan(f.half_fov) * overhead_error(f, best_near(f), z).t; });
    return c;
}

struct Parts {
    Frustum f;
    std::vector<double> ends;
    Warp warp;
};

Parts four(double near, double split, Warp warp)
{
    Parts out{{near, 1000.0, 30.0 * degree}, {}, warp};
    for (const float end : cascade_ends(float(near), 1000.0f, 4, float(split))) out.ends.push_back(double(end));
    return out;
}

double error_of(const Parts& p, bool t, double z)
{
    if (z < p.f.near) return nothing;
    const Error e = partitioned_error(p.f, p.ends, p.warp, z);
    return t ? e.t : e.s;
}

Curves splits(bool t)
{
    Curves c{t ? "splits_t" : "splits_s", t ? "Four maps: error in t" : "Four maps: error in s", "", "depth in the view / near plane",
        "pixels per texel", true, true, geometric(1, 1000, 301), {}};
    c.text = t ? "As figure 4.16, far/near = 1000: parts at logarithmic splits or at practical ones (half way to even ones), with and "
                 "without the optimal warp. Logarithmic splits with warps meet in t and have the least maximum; practical splits "
                 "have less error far away and much more close by."
               : "The same in s: the width of a texel almost doubles from one warped part to the next.";
    const std::tuple<const char*, double, Warp> schemes[] = {{"logarithmic, uniform", 1.0, Warp::none},
        {"practical, uniform", 0.5, Warp::none}, {"logarithmic, warped", 1.0, Warp::optimal}, {"practical, warped", 0.5, Warp::optimal}};
    for (size_t i = 0; i < std::size(schemes); ++i) {
        const auto& [name, split, warp] = schemes[i];
        const Parts parts = four(1.0, split, warp);
        add(c, name, i / 2, i % 2, [&](double z) { return error_of(parts, t, z); });
    }
    return c;
}

Curves nearest(bool t)
{
    Curves c{t ? "nearest_t" : "nearest_s",
        t ? "From the nearest visible depth on: error in t" : "From the nearest visible depth on: error in s", "",
        "depth in the view / near plane", "pixels per texel", true, true, geometric(1, 1000, 301), {}};
    c.text = t
        ? "As figures 4.17 and 4.18: where nothing is nearer than 13, four maps that begin there waste none of their texels. A single "
          "warped map with a pseudo near plane at 13 has a third of the error from there on, and still shadows what is nearer, coarsely."
        : "The same in s.";
    const std::tuple<const char*, double, Warp> schemes[] = {{"4 uniform, from 1", 1.0, Warp::none},
        {"4 uniform, from 13", 13.0, Warp::none}, {"4 warped, from 1", 1.0, Warp::optimal}, {"4 warped, from 13", 13.0, Warp::optimal}};
    for (size_t i = 0; i < std::size(schemes); ++i) {
        const auto& [name, near, warp] = schemes[i];
        const Parts parts = four(near, 1.0, warp);
        add(c, name, i / 2, i % 2, [&](double z) { return error_of(parts, t, z); });
    }
    const Frustum f = frustum(1000);
    const auto single
        = [&](double n) { return [&f, n, t](double z) { return t ? overhead_error(f, n, z).t : overhead_error(f, n, z).s; }; };
    add(c, "1 warped, from 1", 2, 0, single(best_near(f)));
    add(c, "1 warped, pseudo near plane 13", 2, 1, single(pseudo_near(f.near, f.far, f.depth(), 13.0, f.far)));
    return c;
}

Curves storage_maps()
{
    const Frustum f = frustum(1000);
    Curves c{"storage_maps", "Texels needed by the number of maps", "", "maps", "storage factor S", false, true, {}, {}};
    for (int i = 1; i <= 25; ++i) c.x.push_back(i);
    c.text
        = "As figure 4.19, far/near = 1000. Overhead, warps need fewer texels, less so the more parts there are; both approach the "
          "logarithmic limit. Where the light shines along the view, parts gain up to 2 ln(far/near) of them, and cutting the frustum by "
          "its faces wins from about 17 maps on. Overhead, faces are the same as warped parts.";
    add(c, "overhead, uniform parts", 0, 0, [&](double k) { return partitioned_storage_uniform(f, k); });
    add(c, "overhead, warped parts", 2, 0, [&](double k) { return partitioned_storage_warped(f, k); });
    add(c, "along the view, parts", 0, 1, [&](double k) { return partitioned_storage_behind(f, k); });
    add(c, "along the view, warped faces", 2, 1,
        [&](double k) { return int(k) % 4 == 1 && k > 1 ? face_storage_behind(f, (k - 1.0) / 4.0) : nothing; });
    add(c, "logarithmic", 3, 0, [&](double) { return logarithmic_storage(f); });
    return c;
}

Curves storage_ratio()
{
    Curves c{
        "storage_ratio", "Texels needed by the view's depth", "", "far / near", "storage factor S", true, true, geometric(2, 1e4, 75), {}};
    c.text
        = "For an overhead light: (4.25), (4.23), (4.38), (4.39), (4.35). A single map without a warp needs (far/near)^2 times a constant.";
    add(c, "uniform", 0, 0, [](double r) { return overhead_storage(frustum(r), no_warp); });
    add(c, "warped", 2, 0, [](double r) { return overhead_storage(frustum(r), best_near(frustum(r))); });
    for (const int k : {2, 4, 8}) {
        add(c, std::to_string(k) + " uniform parts", 0, size_t(k / 2),
            [k](double r) { return partitioned_storage_uniform(frustum(r), k); });
        add(c, std::to_string(k) + " warped parts", 2, size_t(k / 2), [k](double r) { return partitioned_storage_warped(frustum(r), k); });
    }
    add(c, "logarithmic", 3, 0, [](double r) { return logarithmic_storage(frustum(r)); });
    return c;
}

Curves warp_strength()
{
    const Frustum f = frustum(100);
    Curves c{
        "warp_strength", "How strong a warp", "", "near plane of the warp, n / near plane", "", true, true, geometric(1, 1e4, 121), {}};
    c.y_label = "storage factor, largest errors";
    c.text
        = "An overhead light, far/near = 100. The storage factor is level from the view's own perspective (n = 1) to the optimum at 11 and "
          "rises to that of no warp. Where M_t and M_s cross, a square map for a square picture is used best; smaller n ask for ever "
          "higher maps.";
    add(c, "S", 0, 0, [&](double n) { return overhead_storage(f, n); });
    add(c, "largest error in t, M_t", 1, 0, [&](double n) { return overhead_largest(f, n).t; });
    add(c, "largest error in s, M_s", 2, 0, [&](double n) { return overhead_largest(f, n).s; });
    add(c, "M_t / M_s", 3, 1, [&](double n) { return overhead_side_ratio(f, n); });
    return c;
}

const char* const tilt_label = "angle between light and view, degrees";

std::vector<double> tilts()
{
    std::vector<double> out;
    for (int i = 1; i <= 45; ++i) out.push_back(2.0 * i);
    return out;
}

Curves tilt()
{
    const Frustum f = frustum(100);
    Curves c{"tilt", "Texels needed by the light's tilt", "", tilt_label, "storage factor S", false, true, tilts(), {}};
    c.text = "far/near = 100, half a field of view of 30 degrees. Below it a side of the frustum is edge-on to the light, and the warp of "
             "(4.17), "
             "which is scaled by the sine of the angle, is up to 2.5 times worse than none. With Lloyd's falloff it is not.";
    const auto factor = [&](double gamma, double n) { return storage(tilted_largest(f, gamma * degree, n)); };
    add(c, "uniform", 0, 0, [&](double g) { return factor(g, no_warp); });
    add(c, "(4.17)", 1, 0, [&](double g) { return factor(g, tilted_optimal_near(f, g * degree)); });
    add(c, "Lloyd's falloff", 2, 0, [&](double g) { return factor(g, tilted_shaped_near(f, g * degree)); });
    add(c, "best by search", 3, 1, [&](double g) { return factor(g, tilted_best_near(f, g * degree)); });
    return c;
}

Curves tilt_near()
{
    const Frustum f = frustum(100);
    Curves c{"tilt_near", "Warps by the light's tilt", "", tilt_label, "near plane of the warp, n / near plane", false, true, tilts(), {}};
    c.text = "The same; where a curve has no value there is no warp.";
    add(c, "(4.17)", 1, 0, [&](double g) { return tilted_optimal_near(f, g * degree); });
    add(c, "Lloyd's falloff", 2, 0, [&](double g) { return tilted_shaped_near(f, g * degree); });
    return c;
}

} // namespace

std::vector<Curves> error_curves()
{
    return {warps(), spacing(), warp_strength(), splits(true), splits(false), nearest(true), nearest(false), storage_maps(),
        storage_ratio(), tilt(), tilt_near()};
}

} // namespace gnomon::lab
