// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "truth/geometry.h"
#include "truth/truth.h"

#include <algorithm>
#include <limits>
#include <tbb/blocked_range.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace gnomon::truth {

/// A thread's portion of a picture: wide and flat, since the arrays that are read and written lie in rows, and the processor fetches
/// ahead along them.
inline constexpr int tile_width = 128, tile_height = 8;

// A packet is 4x2 pixels, or 4x2 strata of a light. Not 16 rays: in Debian 12's Embree 3.13.5 the coherent traversal of 16 rays for
// AVX-512 is miscompiled (GCC 12 stores the lanes still to do as 16 bits and reads them back as 64), so that now and then the call
// traces lanes that do not exist and never returns. 8 rays are within a tenth of its speed.
inline constexpr int packet_width = 4, packet_height = 2, lanes = packet_width * packet_height;

/// Rays through pixel centres, affine in the pixel: one view_ray a pixel would cost as much as tracing it.
class PixelRays {
public:
    explicit PixelRays(const scene::View&);
    /// The direction has length 1 along the view axis, so that the ray parameter of an eye ray is its depth.
    scene::Ray at(int x, int y) const
    {
        const double px = x + 0.5, py = y + 0.5;
        return {vec3(origin_[0] + px * origin_[1] + py * origin_[2]), vec3(direction_[0] + px * direction_[1] + py * direction_[2])};
    }
    /// Where all rays cross the near plane; what lies before it the rasteriser clips.
    float near_parameter() const { return near_; }
    /// Distance of a point along the view axis.
    float depth(vec3 p) const { return float(glm::dot(axis_, glm::dvec3(p) - eye_)); }

private:
    glm::dvec3 origin_[3], direction_[3]; ///< value at (0, 0), and steps in x and y
    glm::dvec3 axis_, eye_;
    float near_;
};

/// A point that receives light: position, unit normal on the eye's side, and how far a shadow ray begins off the surface.
struct Receiver {
    vec3 p, n;
    float offset;
};

/// How far to move off a surface so that neither it nor a neighbour in its plane is hit. C. Waechter, N. Binder, "A Fast and Robust
/// Method for Avoiding Self-Intersection", Ray Tracing Gems (2019), ch. 6: the error has one part that grows with the coordinates and
/// one with the triangle. The first is a few roundings of `p` (half an ulp each for p, the shifted origin and the triangle's
/// corners). The second comes from Embree's test itself: with C = corner - origin, the distance dot(Ng, C) / |Ng| is wrong by about
/// 6 eps |C|. Differs from the chapter: we know both parts, so a length replaces its empirical integer steps.
inline float surface_offset(vec3 p, float extent)
{
    constexpr float eps = 0x1p-24f; // half an ulp, relative
    const vec3 a = glm::abs(p);
    return eps * (8.0f * std::max(a.x, std::max(a.y, a.z)) + 16.0f * extent) + std::numeric_limits<float>::min();
}

/// The far end of shadow rays: lifted off the light's own plane, since the lamp is often modelled there too.
struct Emitter {
    explicit Emitter(const scene::Light&);
    const scene::Light& light;
    vec3 normal{0}; ///< rect and disk
    float extent = 0.0f;
    bool shorten = false; ///< point and spot
};

/// Rays for rtcOccluded8. Idle lanes hold a harmless ray, because Embree's assertions look at them too.
struct alignas(32) Packet {
    RTCRay8 ray;
    int valid[lanes];
    Packet();
    void clear() { std::fill(std::begin(valid), std::end(valid), 0); }
};

enum class Path { dark, lit, ray };
/// Puts the open segment from the receiver to a light point into a lane; or says that none is needed.
inline Path aim(const Receiver& r, const Emitter& e, vec4 light_point, Packet& packet, int lane)
{
    const vec3 l(light_point);
    const bool point = light_point.w != 0.0f;
    const vec3 towards = point ? l - r.p : l;
    if (!(glm::dot(r.n, towards) > 0.0f)) return Path::dark;
    const vec3 origin = r.p + r.offset * r.n;
    vec3 direction = l;
    float tfar = std::numeric_limits<float>::infinity();
    if (point) {
        // Lifted along the light's normal, or where it has none (normal 0) shortened along the ray; by the largest component, which
        // is up to sqrt(3) too much but needs no root.
        const float lift = surface_offset(l, e.extent);
        direction = l + lift * e.normal - origin;
        const vec3 a = glm::abs(direction);
        tfar = 1.0f - 0x1p-22f - (e.shorten ? lift / std::max(a.x, std::max(a.y, a.z)) : 0.0f);
        // The light touches the surface: nothing fits between.
        if (!(tfar > 0.0f) || !(glm::dot(direction, towards) > 0.0f)) return Path::lit;
    }
    packet.ray.org_x[lane] = origin.x, packet.ray.org_y[lane] = origin.y, packet.ray.org_z[lane] = origin.z;
    packet.ray.dir_x[lane] = direction.x, packet.ray.dir_y[lane] = direction.y, packet.ray.dir_z[lane] = direction.z;
    packet.ray.tfar[lane] = tfar;
    packet.valid[lane] = -1;
    return Path::ray;
}

/// Traces the valid lanes and stores what comes through: 0 or 1 in each channel, or the product of transmittances.
void trace(const Geometry&, Quantity, Packet&, vec3 (&through)[lanes]);

/// Runs body(x0, y0, x1, y1) over all tiles.
template <class Body> void for_tiles(base::Size size, int threads, Body body)
{
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    const int rows = (size.height + tile_height - 1) / tile_height, columns = (size.width + tile_width - 1) / tile_width;
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, 1, 0, columns, 1), [&](const tbb::blocked_range2d<int>& r) {
            for (int row = r.rows().begin(); row < r.rows().end(); ++row)
                for (int column = r.cols().begin(); column < r.cols().end(); ++column)
                    body(column * tile_width, row * tile_height, std::min(size.width, (column + 1) * tile_width),
                        std::min(size.height, (row + 1) * tile_height));
        });
    });
}

/// Fills a packet with the eye rays of the 4x2 pixels at (x0, y0).
void aim_primary(const PixelRays&, base::Size, int x0, int y0, RTCRayHit8&, int (&valid)[lanes]);

/// From a pixel of Primary to its receiver. Remembers the last instance: neighbours are mostly of one.
class Receivers {
public:
    Receivers(const Geometry& geometry, const Primary& primary)
        : geometry_(geometry)
        , primary_(primary)
    {
    }
    /// Asks for a pixel that is read soon: the three arrays are larger than the caches.
    void prefetch(size_t pixel) const
    {
#if defined(__GNUC__)
        if (pixel >= primary_.primitive.size()) return;
        __builtin_prefetch(primary_.primitive.data() + pixel);
        __builtin_prefetch(primary_.position.values.data() + pixel * 3);
        __builtin_prefetch(primary_.normal.values.data() + pixel * 3);
#else
        (void)pixel;
#endif
    }
    bool seen(size_t pixel) const { return primary_.primitive[pixel] != no_primitive; }
    Receiver at(size_t pixel)
    {
        const uint32_t id = primary_.primitive[pixel];
        if (id < first_ || id >= end_) find(id);
        const float* p = primary_.position.values.data() + pixel * 3;
        const float* n = primary_.normal.values.data() + pixel * 3;
        const vec3 position(p[0], p[1], p[2]);
        return {position, vec3(n[0], n[1], n[2]), surface_offset(position, extent_)};
    }

private:
    void find(uint32_t primitive);
    const Geometry& geometry_;
    const Primary& primary_;
    uint32_t first_ = 0, end_ = 0; ///< primitives of the last instance
    float extent_ = 0.0f; ///< and its largest triangle
};

struct Tracer::Impl {
    Geometry geometry;
};

} // namespace gnomon::truth
