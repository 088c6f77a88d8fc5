// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/progress.h"
#include "truth/rays.h"
#include "truth/sampling.h"

#include <algorithm>
#include <cassert>

namespace gnomon::truth {

namespace {

/// The light samples of one receiver after another. One object a tile: it owns the buffers.
class SoftPixel {
public:
    SoftPixel(const Geometry& geometry, const Emitter& emitter, const Strata& strata, Quantity quantity, const scene::LightImage& image)
        : geometry_(geometry)
        , emitter_(emitter)
        , strata_(strata)
        , quantity_(quantity)
        , channels_(quantity == Quantity::visibility && image.empty() ? 1 : 3)
    {
        for (int c = 0; c < channels_; ++c) values_[c].resize(size_t(strata.count()));
        if (image.empty()) return;
        for (int row = 0; row < strata.rows; ++row)
            for (int column = 0; column < strata.columns; ++column) {
                const vec3 emitted = image.at((vec2(column, row) + 0.5f) / vec2(strata.columns, strata.rows));
                for (int c = 0; c < channels_; ++c) weights_[c].push_back(emitted[c]);
            }
    }
    int channels() const { return channels_; }
    void measure(uint64_t pixel, const Receiver&, Estimate (&out)[3]);

private:
    void block(uint64_t pixel, const Receiver&, int column0, int row0);

    const Geometry& geometry_;
    const Emitter& emitter_;
    const Strata& strata_;
    Quantity quantity_;
    int channels_;
    Packet packet_;
    std::vector<float> values_[3], weights_[3]; ///< of each stratum; no weights: all are 1
};

void SoftPixel::measure(uint64_t pixel, const Receiver& r, Estimate (&out)[3])
{
    for (int row = 0; row < strata_.rows; row += packet_height)
        for (int column = 0; column < strata_.columns; column += packet_width) block(pixel, r, column, row);
    for (int c = 0; c < channels_; ++c) {
        out[c] = estimate(values_[c], strata_.columns, weights_[c]);
        out[c].mean = std::min(out[c].mean, 1.0); // a sum of weights may be rounded up
    }
}

/// Neighbouring strata share a packet, since their rays are alike.
void SoftPixel::block(uint64_t pixel, const Receiver& r, int column0, int row0)
{
    packet_.clear();
    vec3 through[lanes];
    bool any = false;
    for (int i = 0; i < lanes; ++i) {
        const int column = column0 + i % packet_width, row = row0 + i / packet_width;
        if (column >= strata_.columns || row >= strata_.rows) continue;
        const Path path = aim(r, emitter_, scene::light_point(emitter_.light, r.p, strata_.point(pixel, column, row)), packet_, i);
        through[i] = vec3(path == Path::lit ? 1.0f : 0.0f);
        any = any || path == Path::ray;
    }
    if (any) trace(geometry_, quantity_, packet_, through);
    for (int i = 0; i < lanes; ++i) {
        const int column = column0 + i % packet_width, row = row0 + i / packet_width;
        if (column >= strata_.columns || row >= strata_.rows) continue;
        const size_t stratum = size_t(row) * size_t(strata_.columns) + size_t(column);
        for (int c = 0; c < channels_; ++c) values_[c][stratum] = through[i][c];
    }
}

struct Job {
    const Geometry& geometry;
    const Emitter& emitter;
    base::Size size;
    Quantity quantity;
    Visibility& out;

    void soft(Receivers&, SoftPixel&, int x, int y) const;
    void hard(Receivers&, Packet&, vec4 light_point, int x0, int y0, int x1, int y1) const;
};

void Job::soft(Receivers& receivers, SoftPixel& pixel, int x, int y) const
{
    const size_t index = size_t(y) * size_t(size.width) + size_t(x);
    const int channels = pixel.channels();
    Estimate value[3];
    if (!receivers.seen(index)) {
        for (Estimate& e : value) e.mean = 1.0;
    } else {
        const Receiver r = receivers.at(index);
        if (scene::reaches(emitter.light, r.p)) pixel.measure(index, r, value);
    }
    for (int c = 0; c < channels; ++c) {
        out.mean.values[index * size_t(channels) + size_t(c)] = float(value[c].mean);
        out.variance.values[index * size_t(channels) + size_t(c)] = float(value[c].variance);
    }
}

/// One ray a pixel; a packet is 4x2 pixels.
void Job::hard(Receivers& receivers, Packet& packet, vec4 light_point, int x0, int y0, int x1, int y1) const
{
    packet.clear();
    for (int row = 0; row < packet_height; ++row) receivers.prefetch(size_t(y0 + row) * size_t(size.width) + size_t(x0) + 4 * packet_width);
    vec3 through[lanes];
    bool any = false;
    for (int i = 0; i < lanes; ++i) {
        const int x = x0 + i % packet_width, y = y0 + i / packet_width;
        if (x >= x1 || y >= y1) continue;
        const size_t index = size_t(y) * size_t(size.width) + size_t(x);
        Path path = Path::lit;
        if (receivers.seen(index)) {
            const Receiver r = receivers.at(index);
            path = scene::reaches(emitter.light, r.p) ? aim(r, emitter, light_point, packet, i) : Path::dark;
        }
        through[i] = vec3(path == Path::lit ? 1.0f : 0.0f);
        any = any || path == Path::ray;
    }
    if (any) trace(geometry, quantity, packet, through);
    const int channels = out.mean.channels;
    for (int i = 0; i < lanes; ++i) {
        const int x = x0 + i % packet_width, y = y0 + i / packet_width;
        if (x >= x1 || y >= y1) continue;
        for (int c = 0; c < channels; ++c) out.mean.at(x, y, c) = through[i][c];
    }
}

Strata strata_of(const scene::Light& light, const scene::LightImage& image, const Settings& settings)
{
    return {light.soft() ? settings.samples : 1, settings.seed, image.empty() ? glm::ivec2(1) : glm::ivec2(image.width, image.height)};
}

const scene::LightImage uniform;

Visibility run(const Geometry& geometry, const scene::View& view, const Primary& primary, const scene::Light& light,
    const Settings& settings, Quantity quantity)
{
    assert(primary.depth.size == view.size);
    const Emitter emitter(light);
    const scene::LightImage& image = light.textured() ? light.image : uniform;
    const Strata strata = strata_of(light, image, settings);
    const int count = channels(quantity, light);
    Visibility result{base::Picture(view.size, count), base::Picture(view.size, count), strata.count()};
    const Job job{geometry, emitter, view.size, quantity, result};
    const vec4 centre = scene::light_point(light, vec3(0.0f), vec2(0.5f)); // of a hard light: the same from everywhere
    base::Progress progress("tracing light samples", view.size.area());
    for_tiles(view.size, settings.threads, [&](int x0, int y0, int x1, int y1) {
        Receivers receivers(geometry, primary);
        SoftPixel pixel(geometry, emitter, strata, quantity, image);
        Packet packet;
        for (int y = y0; y < y1; y += light.soft() ? 1 : packet_height)
            for (int x = x0; x < x1; x += light.soft() ? 1 : packet_width) {
                if (settings.stop.stop_requested()) base::fail("tracing light samples was stopped; nothing of it is kept");
                if (light.soft())
                    job.soft(receivers, pixel, x, y);
                else
                    job.hard(receivers, packet, centre, x, y, x1, y1);
            }
        progress.advance(uint64_t(x1 - x0) * uint64_t(y1 - y0));
    });
    return result;
}

std::vector<glm::dvec3> at_points(const Geometry& geometry, const std::vector<vec3>& points, const std::vector<vec3>& normals,
    const scene::Light& light, const scene::LightImage& image, const Settings& settings)
{
    assert(points.size() == normals.size());
    const Emitter emitter(light);
    const Strata strata = strata_of(light, image, settings);
    std::vector<glm::dvec3> result(points.size());
    tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size()), [&](const tbb::blocked_range<size_t>& range) {
            SoftPixel pixel(geometry, emitter, strata, Quantity::visibility, image);
            for (size_t i = range.begin(); i < range.end(); ++i) {
                // The triangle is not known, so the scene's size bounds its error.
                const Receiver r{points[i], normals[i], surface_offset(points[i], geometry.radius())};
                Estimate value[3];
                if (scene::reaches(light, r.p)) pixel.measure(i, r, value);
                const int c = pixel.channels() - 1; // 0 or 2
                result[i] = glm::dvec3(value[0].mean, value[c / 2].mean, value[c].mean);
            }
        });
    });
    return result;
}

} // namespace

int channels(Quantity quantity, const scene::Light& light) { return quantity == Quantity::visibility && !light.textured() ? 1 : 3; }

Tracer::Tracer(const scene::Scene& scene, size_t flatten_limit)
    : impl_(new Impl{Geometry(scene, flatten_limit)})
{
}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
double Tracer::build_ms() const { return impl_->geometry.build_ms(); }

Visibility Tracer::visibility(const scene::View& view, const Primary& primary, const scene::Light& light, const Settings& settings) const
{
    return run(impl_->geometry, view, primary, light, settings, Quantity::visibility);
}

Visibility Tracer::transmittance(const scene::View& view, const Primary& primary, const scene::Light& light, const Settings& settings) const
{
    return run(impl_->geometry, view, primary, light, settings, Quantity::transmittance);
}

std::vector<double> Tracer::visibility_at(
    const std::vector<vec3>& points, const std::vector<vec3>& normals, const scene::Light& light, const Settings& settings) const
{
    std::vector<double> result;
    for (const glm::dvec3& v : at_points(impl_->geometry, points, normals, light, uniform, settings)) result.push_back(v.x);
    return result;
}

std::vector<glm::dvec3> Tracer::colored_visibility_at(
    const std::vector<vec3>& points, const std::vector<vec3>& normals, const scene::Light& light, const Settings& settings) const
{
    return at_points(impl_->geometry, points, normals, light, light.textured() ? light.image : uniform, settings);
}

} // namespace gnomon::truth
