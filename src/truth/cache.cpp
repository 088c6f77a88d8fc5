// SPDX-License-Identifier: Apache-2.0
#include "truth/cache.h"

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "truth/sampling.h"

#include <algorithm>
#include <cstring>

namespace gnomon::truth {

namespace fs = std::filesystem;

namespace {

/// Raise it whenever a change of this folder, or of scene::light_point, reaches, view_ray or transmittance, changes a value.
constexpr uint32_t version = 4;
constexpr std::string_view extension = ".truth";

void add_use(base::Hasher& h, const scene::Scene& s, const scene::TextureUse& use)
{
    h.value(use.u_row).value(use.v_row);
    if (use.texture < 0 || size_t(use.texture) >= s.textures.size()) return;
    const scene::Texture& t = s.textures[size_t(use.texture)];
    h.value(t.width).value(t.height).value(t.srgb).value(t.linear).value(t.wrap_u).value(t.wrap_v).array(t.rgba);
}

/// Only what rays can feel: an opaque material's colours do not count, so a texture of gigabytes is not read for nothing.
void add_scene(base::Hasher& h, const scene::Scene& s)
{
    for (const scene::Material& m : s.materials) {
        h.value(m.alpha).value(m.double_sided).value(m.transmission > 0.0f);
        if (m.alpha == scene::AlphaMode::opaque && m.transmission <= 0.0f) continue;
        h.value(m.base_color).value(m.alpha_cutoff).value(m.transmission).value(m.thickness);
        h.value(m.attenuation_color).value(m.attenuation_distance);
        add_use(h, s, m.base_color_texture);
    }
    for (const scene::Mesh& m : s.meshes) h.array(m.positions).array(m.indices).array(m.uvs).array(m.colors).value(m.material);
    for (const scene::Instance& i : s.instances) h.value(i.mesh).value(i.world_from_object);
}

void add_view(base::Hasher& h, const scene::View& v)
{
    h.value(v.view_from_world).value(v.clip_from_view).value(v.eye).value(v.near).value(v.orthographic).value(v.size);
}

void add_light(base::Hasher& h, const scene::Light& light)
{
    h.value(light.shape.index());
    std::visit([&](const auto& shape) { h.value(shape); }, light.shape);
    if (light.textured()) h.value(light.image.width).value(light.image.height).array(light.image.texels);
}

std::string checksum(std::span<const std::byte> data) { return base::Hasher().bytes(data).hex(); }

struct Header {
    char magic[8] = {'G', 'N', 'T', 'R', 'U', 'T', 'H', 0};
    uint32_t format = version;
    int32_t width = 0, height = 0, channels = 0, samples = 0;
    char checksum[32] = {};
};
static_assert(sizeof(Header) == 60 && std::is_trivially_copyable_v<Header>);

/// The arrays in their order in the file.
template <class R, class F> void for_arrays(R& r, F f)
{
    f(r.primary.depth.values);
    f(r.primary.position.values);
    f(r.primary.normal.values);
    f(r.primary.primitive);
    f(r.visibility.mean.values);
    f(r.visibility.variance.values);
}

fs::path entry(const fs::path& folder, const std::string& key) { return folder / (key + std::string(extension)); }

} // namespace

std::string cache_key(const scene::Scene& s, const scene::View& v, const scene::Light& l, const Settings& settings, Quantity quantity)
{
    base::Hasher h;
    h.value(version).value(quantity).value(l.soft() ? Strata(settings.samples, 0).columns : 1).value(l.soft() ? settings.seed : 0);
    add_scene(h, s);
    add_view(h, v);
    add_light(h, l);
    return h.hex();
}

std::optional<Reference> load(const fs::path& folder, const std::string& key, base::Size size, int channels)
try {
    const fs::path path = entry(folder, key);
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return {};
    const std::vector<std::byte> file = base::read_file(path, cache_limit);
    Header header;
    const Header expected;
    if (file.size() < sizeof(Header)) return {};
    std::memcpy(&header, file.data(), sizeof(Header));
    const std::span payload = std::span(file).subspan(sizeof(Header));
    const size_t pixel_bytes = sizeof(float) * (1 + 3 + 3 + 1 + 2 * size_t(channels));
    if (std::memcmp(header.magic, expected.magic, sizeof(header.magic)) != 0 || header.format != version || header.width != size.width
        || header.height != size.height || header.channels != channels || payload.size() != size.area() * pixel_bytes
        || checksum(payload) != std::string_view(header.checksum, sizeof(header.checksum)))
        return {};

    Reference r;
    r.primary.depth = base::Picture(size, 1);
    r.primary.position = base::Picture(size, 3);
    r.primary.normal = base::Picture(size, 3);
    r.primary.primitive.resize(size.area());
    r.visibility = {base::Picture(size, channels), base::Picture(size, channels), header.samples};
    size_t at = 0;
    for_arrays(r, [&](auto& values) {
        const size_t bytes = values.size() * sizeof(values[0]);
        std::memcpy(values.data(), payload.data() + at, bytes);
        at += bytes;
    });
    r.from_cache = true;
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);
    return r;
} catch (const base::Error&) { // the entry vanished or cannot be read: as if it were not there
    return {};
}

void store(const fs::path& folder, const std::string& key, const Reference& r)
{
    std::vector<std::byte> file(sizeof(Header));
    for_arrays(r, [&](const auto& values) {
        const std::span bytes = std::as_bytes(std::span(values));
        file.insert(file.end(), bytes.begin(), bytes.end());
    });
    Header header;
    header.width = r.primary.depth.size.width, header.height = r.primary.depth.size.height;
    header.channels = r.visibility.mean.channels, header.samples = r.visibility.samples;
    const std::string sum = checksum(std::span(file).subspan(sizeof(Header)));
    std::memcpy(header.checksum, sum.data(), sizeof(header.checksum));
    std::memcpy(file.data(), &header, sizeof(Header));
    base::write_file(entry(folder, key), file);
}

void prune(const fs::path& folder, uint64_t limit)
{
    struct Entry {
        fs::file_time_type used;
        uint64_t size;
        fs::path path;
    };
    std::vector<Entry> entries;
    uint64_t total = 0;
    // Other processes may add and delete at the same time; what cannot be read is left alone.
    std::error_code error;
    for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
        if (i->path().extension() != extension) continue;
        std::error_code ignored;
        const Entry e{i->last_write_time(ignored), i->file_size(ignored), i->path()};
        if (ignored) continue;
        entries.push_back(e);
        total += e.size;
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (size_t i = 0; i < entries.size() && total > limit; ++i) {
        std::error_code ignored;
        if (fs::remove(entries[i].path, ignored)) total -= entries[i].size;
    }
}

} // namespace gnomon::truth
