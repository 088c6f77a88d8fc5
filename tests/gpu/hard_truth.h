// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace gnomon {

using dvec3 = glm::dvec3;
using Triangle = std::array<dvec3, 3>;

/// What stands before a point, in double precision and against every triangle. Where a triangle's edge or plane passes within `margin`
/// metres of the ray, or of the point, single precision and the technique's own offsets may decide either way: unknown. Such is the
/// margin of scenes some metres wide; `scale` is the size of others in their terms.
enum class Verdict { dark, lit, unknown };

class HardTruth {
public:
    HardTruth(const scene::Scene& s, scene::Light light, double scale = 1)
        : light_(std::move(light))
        , margin_(4e-4 * scale)
        , in_plane_(1e-9 * scale)
    {
        for (const scene::Instance& i : s.instances) {
            const scene::Mesh& m = s.meshes[size_t(i.mesh)];
            for (size_t t = 0; t + 2 < m.indices.size(); t += 3) {
                Triangle out;
                for (size_t k = 0; k < 3; ++k)
                    out[k] = dvec3(glm::dmat4(i.world_from_object) * glm::dvec4(dvec3(m.positions[m.indices[t + k]]), 1));
                triangles_.push_back(out);
            }
        }
    }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    static dvec3 normal(const Triangle& t) { return glm::cross(t[1] - t[0], t[2] - t[0]); }

    /// `own`: the triangle on which p lies, seen from the side of n (unit).
    Verdict at(dvec3 p, dvec3 n, size_t own) const
    {
        const scene::LightKind kind = light_.kind();
        if (kind == scene::LightKind::spot) {
            const auto& spot = std::get<scene::SpotLight>(light_.shape);
            const dvec3 from = p - dvec3(spot.position);
            const double angle = std::acos(std::clamp(glm::dot(glm::normalize(from), glm::normalize(dvec3(spot.direction))), -1.0, 1.0));
            if (std::abs(angle - double(spot.outer_angle)) < 1e-4) return Verdict::unknown;
            if (angle > double(spot.outer_angle)) return Verdict::dark;
        }
        const double facing = glm::dot(n, glm::normalize(to_light(p)));
        if (std::abs(facing) < 1e-3) return Verdict::unknown;
        if (facing < 0) return Verdict::dark;
        Verdict result = Verdict::lit;
        for (size_t i = 0; i < triangles_.size(); ++i) {
            if (i == own || in_plane(triangles_[own], triangles_[i])) continue; // it lies beside, not before
            const Verdict one = behind(triangles_[i], p);
            if (one == Verdict::dark) return one;
            if (one == Verdict::unknown) result = one;
        }
        return result;
    }

    dvec3 to_light(dvec3 p) const
    {
        if (light_.kind() == scene::LightKind::directional)
            return -glm::normalize(dvec3(std::get<scene::DirectionalLight>(light_.shape).direction));
        if (light_.kind() == scene::LightKind::spot) return dvec3(std::get<scene::SpotLight>(light_.shape).position) - p;
        return dvec3(std::get<scene::PointLight>(light_.shape).position) - p;
    }

    /// Whether one triangle stands between p and the light.
    Verdict behind(const Triangle& t, dvec3 p) const
    {
        const dvec3 n = normal(t);
        const double area = glm::length(n);
        if (!(area > 0)) return Verdict::lit; // no ray meets it, nor one with a corner that is not a number
        const double light_height = glm::dot(n, to_light(t[0])) / area, height = glm::dot(n, p - t[0]) / area * (light_height < 0 ? -1 : 1);
        if (height > margin_) return Verdict::lit;
        double least = 1e30, most = -1e30;
        for (size_t k = 0; k < 3; ++k) {
            const dvec3 a = t[(k + 1) % 3], b = t[(k + 2) % 3], plane = glm::cross(to_light(a), b - a);
            const double length = glm::length(plane), distance = length > 0 ? glm::dot(plane, p - a) / length : 0;
            least = std::min(least, distance), most = std::max(most, distance);
        }
        if (least < -margin_ && most > margin_) return Verdict::lit;
        const bool inside = least > margin_ || most < -margin_;
        return inside && height < -margin_ && std::abs(light_height) > margin_ ? Verdict::dark : Verdict::unknown;
    }

private:
    bool in_plane(const Triangle& own, const Triangle& other) const
    {
        const dvec3 n = normal(own);
        const auto off = [&](dvec3 p) { return std::abs(glm::dot(n, p - own[0])); };
        return std::max(off(other[0]), std::max(off(other[1]), off(other[2]))) < in_plane_ * glm::length(n);
    }

    scene::Light light_;
    double margin_, in_plane_; ///< metres
    std::vector<Triangle> triangles_;
};

} // namespace gnomon
