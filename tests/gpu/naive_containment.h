// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hard_truth.h"

#include "scene/view.h"

#include <limits>

namespace gnomon {

/// The oldest form of shadow volumes (H. Fuchs et al., "Fast Spheres, Shadows, Textures, Transparencies, and Image Enhancements in
/// Pixel-Planes", SIGGRAPH 1985): every sample against the four planes of every triangle's volume, here in double precision. Unlike
/// HardTruth it takes the point from the depth image, as techniques do, so that a narrower band is left where either answer is right.
class NaiveContainment {
public:
    NaiveContainment(const HardTruth& truth, const scene::View& view)
        : truth_(truth)
        , world_from_clip_(view.world_from_clip)
        , size_(view.size)
    {
    }

    dvec3 point(size_t pixel, float depth) const
    {
        const size_t column = pixel % size_t(size_.width), row = pixel / size_t(size_.width);
        const double x = double(column) + 0.5, y = double(row) + 0.5;
        const glm::dvec4 p = world_from_clip_ * glm::dvec4(2 * x / size_.width - 1, 2 * y / size_.height - 1, double(depth), 1);
        return dvec3(p) / p.w;
    }

    /// How far p lies inside of the volume that holds it deepest, in metres from its nearest plane; negative: outside of all by so much.
    double depth_inside(dvec3 p, size_t own) const
    {
        double deepest = -std::numeric_limits<double>::infinity();
        for (size_t t = 0; t < truth_.triangles().size(); ++t)
            if (t != own) deepest = std::max(deepest, inside_one(truth_.triangles()[t], p));
        return deepest;
    }

private:
    double inside_one(const Triangle& t, dvec3 p) const
    {
        constexpr double outside = -std::numeric_limits<double>::infinity();
        const dvec3 n = HardTruth::normal(t);
        const double area = glm::length(n), height = glm::dot(n, truth_.to_light(t[0]));
        if (!(area > 0) || height == 0) return outside;
        const double turn = height < 0 ? -1 : 1;
        double least = -turn * glm::dot(n, p - t[0]) / area;
        for (size_t k = 0; k < 3; ++k) {
            // Inside is the side of the corner opposite to the edge.
            const dvec3 a = t[(k + 1) % 3], b = t[(k + 2) % 3], side = glm::cross(truth_.to_light(a), b - a);
            const double length = glm::length(side), towards = glm::dot(side, t[k] - a);
            if (length == 0) return outside;
            least = std::min(least, (towards < 0 ? -1 : 1) * glm::dot(side, p - a) / length);
        }
        return least;
    }

    const HardTruth& truth_;
    glm::dmat4 world_from_clip_;
    scene::Size size_;
};

} // namespace gnomon
