// SPDX-License-Identifier: Apache-2.0
#include "truth/benchmark.h"

#include "truth/rays.h"

#include <algorithm>
#include <chrono>

namespace gnomon::truth {

namespace {

struct alignas(32) EyePacket {
    RTCRayHit8 rays;
    int valid[lanes];
};

/// Best of three, each on fresh copies: tracing overwrites the rays.
template <class P, class Trace> double best_ms(const std::vector<P>& packets, int threads, Trace trace)
{
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    double best = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 3; ++run) {
        std::vector<P> copy = packets;
        const auto begin = std::chrono::steady_clock::now();
        arena.execute([&] {
            tbb::parallel_for(tbb::blocked_range<size_t>(0, copy.size(), 64), [&](const tbb::blocked_range<size_t>& range) {
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
                for (size_t i = range.begin(); i < range.end(); ++i) trace(copy[i], context);
            });
        });
        best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    return best;
}

template <class P> uint64_t count_rays(const std::vector<P>& packets)
{
    uint64_t rays = 0;
    for (const P& p : packets) rays += uint64_t(std::count(std::begin(p.valid), std::end(p.valid), -1));
    return rays;
}

} // namespace

RawThroughput raw_packets(const Tracer& tracer, const scene::View& view, const scene::Light& light, int threads)
{
    const Geometry& geometry = tracer.impl_->geometry;
    const PixelRays rays(view);
    const Primary primary = tracer.primary(view, threads);
    const Emitter emitter(light);
    Receivers receivers(geometry, primary);
    std::vector<EyePacket> eye;
    std::vector<Packet> shadow;
    for_tiles(view.size, 1, [&](int x0, int y0, int x1, int y1) {
        for (int y = y0; y < y1; y += packet_height)
            for (int x = x0; x < x1; x += packet_width) {
                EyePacket& seen = eye.emplace_back();
                aim_primary(rays, view.size, x, y, seen.rays, seen.valid);
                Packet& packet = shadow.emplace_back();
                for (int i = 0; i < lanes; ++i) {
                    const int px = x + i % packet_width, py = y + i / packet_width;
                    const size_t index = size_t(py) * size_t(view.size.width) + size_t(px);
                    if (px >= x1 || py >= y1 || !receivers.seen(index)) continue;
                    const Receiver r = receivers.at(index);
                    if (scene::reaches(light, r.p)) aim(r, emitter, scene::light_point(light, r.p, vec2(0.5f)), packet, i);
                }
            }
    });
    RawThroughput result;
    result.primary_rays = count_rays(eye);
    result.shadow_rays = count_rays(shadow);
    result.primary_ms
        = best_ms(eye, threads, [&](EyePacket& p, RTCIntersectContext& c) { rtcIntersect8(p.valid, geometry.solid(), &c, &p.rays); });
    result.shadow_ms
        = best_ms(shadow, threads, [&](Packet& p, RTCIntersectContext& c) { rtcOccluded8(p.valid, geometry.solid(), &c, &p.ray); });
    return result;
}

} // namespace gnomon::truth
