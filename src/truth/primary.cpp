// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"
#include "truth/rays.h"

#include <tbb/parallel_invoke.h>

#include <cmath>

namespace gnomon::truth {

namespace {

using glm::dvec3;

/// The context of the second try, which does not see single-sided triangles from behind.
struct Culling {
    RTCIntersectContext context; ///< first, so that the filter can find the rest
    const Geometry* geometry;
    dvec3 direction[lanes]; ///< of the ray whose id is the index; inside an instance Embree's own is in object space
};

bool culled(const Geometry& geometry, uint32_t instance, uint32_t triangle, dvec3 direction)
{
    return !geometry.material(instance).double_sided && glm::dot(geometry.triangle(instance, triangle).normal(), direction) >= 0.0;
}

void cull(const RTCFilterFunctionNArguments* a)
{
    const auto& c = *reinterpret_cast<const Culling*>(a->context);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const uint32_t instance = Geometry::instance(RTCHitN_geomID(a->hit, a->N, i), RTCHitN_instID(a->hit, a->N, i, 0));
        if (culled(*c.geometry, instance, RTCHitN_primID(a->hit, a->N, i), c.direction[RTCRayN_id(a->ray, a->N, i)])) a->valid[i] = 0;
    }
}

struct Tile {
    const Geometry& geometry;
    const PixelRays& rays;
    base::Size size;
    Primary& out;

    void trace(int x0, int y0) const;
    void store(int x0, int y0, const RTCRayHit8& packet, const int (&lanes_to_store)[lanes]) const;
    /// Position and oriented normal, not yet of unit length.
    void locate(const RTCRayHit8& packet, int lane, size_t pixel, vec3& normal) const;
};

dvec3 direction(const RTCRayHit8& packet, int i) { return {packet.ray.dir_x[i], packet.ray.dir_y[i], packet.ray.dir_z[i]}; }

/// Culling by a filter would slow every ray. So all rays run without one first, and only those that met a back face of a
/// single-sided material run again. They start anew instead of behind that hit: its front-facing twin may lie in the same place.
void Tile::trace(int x0, int y0) const
{
    alignas(32) RTCRayHit8 packet;
    alignas(32) int valid[lanes];
    aim_primary(rays, size, x0, y0, packet, valid);
    Culling c;
    rtcInitIntersectContext(&c.context);
    c.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, geometry.solid(), &c.context, &packet);
    bool any = false;
    alignas(32) int again[lanes];
    for (int i = 0; i < lanes; ++i) {
        const uint32_t id = packet.hit.geomID[i];
        again[i] = valid[i] && id != RTC_INVALID_GEOMETRY_ID
                && culled(geometry, Geometry::instance(id, packet.hit.instID[0][i]), packet.hit.primID[i], direction(packet, i))
            ? -1
            : 0;
        any = any || again[i];
    }
    if (any) {
        alignas(32) RTCRayHit8 second;
        aim_primary(rays, size, x0, y0, second, valid);
        c.context.filter = cull;
        c.geometry = &geometry;
        for (int i = 0; i < lanes; ++i) c.direction[i] = direction(second, i);
        rtcIntersect8(again, geometry.solid(), &c.context, &second);
        store(x0, y0, second, again);
    }
    for (int i = 0; i < lanes; ++i) valid[i] = valid[i] && !again[i] ? -1 : 0;
    store(x0, y0, packet, valid);
}

void Tile::store(int x0, int y0, const RTCRayHit8& packet, const int (&chosen)[lanes]) const
{
    vec3 normal[lanes];
    size_t pixel[lanes];
    int count = 0;
    for (int i = 0; i < lanes; ++i) {
        if (!chosen[i] || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        pixel[count] = size_t(y0 + i / packet_width) * size_t(size.width) + size_t(x0 + i % packet_width);
        locate(packet, i, pixel[count], normal[count]);
        ++count;
    }
    // In a loop of their own the roots and divisions of all lanes overlap; they are the dearest part of a pixel.
    for (int i = 0; i < count; ++i) {
        const vec3 n = normal[i] * (1.0f / std::sqrt(glm::dot(normal[i], normal[i])));
        for (int k = 0; k < 3; ++k) out.normal.values[pixel[i] * 3 + size_t(k)] = n[k];
    }
}

void Tile::locate(const RTCRayHit8& packet, int i, size_t pixel, vec3& normal) const
{
    const uint32_t instance = Geometry::instance(packet.hit.geomID[i], packet.hit.instID[0][i]);
    const Geometry::Triangle t = geometry.triangle(instance, packet.hit.primID[i]);
    // From the barycentrics in double: an error in u and v moves the point inside the plane only, while one in the ray's
    // length would move it off.
    const double u = double(packet.hit.u[i]), v = double(packet.hit.v[i]);
    const vec3 p(t.corner + u * t.edge_u + v * t.edge_v);
    out.depth.values[pixel] = rays.depth(p);
    for (int k = 0; k < 3; ++k) out.position.values[pixel * 3 + size_t(k)] = p[k];
    out.primitive[pixel] = geometry.first_primitives()[instance] + packet.hit.primID[i];

    dvec3 n = t.normal();
    const double square = glm::dot(n, n);
    if (square < 1e-30 || square > 1e30) n /= std::sqrt(square); // the square would leave the range of float
    normal = vec3(glm::dot(n, direction(packet, i)) > 0.0 ? -n : n);
}

} // namespace

Primary Tracer::primary(const scene::View& view, int threads) const
{
    Primary result;
    // The first touch of 32 bytes a pixel is page faults, a tenth of the whole time at 1024x768: all threads share them.
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_invoke([&] { result.position = base::Picture(view.size, 3); }, [&] { result.normal = base::Picture(view.size, 3); },
            [&] { result.depth = base::Picture(view.size, 1); }, [&] { result.primitive.assign(view.size.area(), no_primitive); });
    });
    const PixelRays rays(view);
    const Tile work{impl_->geometry, rays, view.size, result};
    base::Progress progress("tracing the camera's rays", view.size.area());
    for_tiles(view.size, threads, [&](int x0, int y0, int x1, int y1) {
        for (int y = y0; y < y1; y += packet_height)
            for (int x = x0; x < x1; x += packet_width) work.trace(x, y);
        progress.advance(uint64_t(x1 - x0) * uint64_t(y1 - y0));
    });
    return result;
}

} // namespace gnomon::truth
