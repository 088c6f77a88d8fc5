// SPDX-License-Identifier: Apache-2.0
#include "lab/aov.h"

#include "base/hash.h"
#include "lab/render.h"
#include "shadow/parts/texel_footprint.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace gnomon::lab {

const std::vector<std::string>& aov_names()
{
    static const std::vector<std::string> names = {"visibility", "depth", "normal", "geometric_normal", "albedo", "surface", "primitive",
        "position", "motion", "texel_footprint", "texel_footprint_perspective", "texel_footprint_projection"};
    return names;
}

namespace {

/// By the channels of shadow::parts::draw_texel_footprint.
constexpr const char* footprint_names[] = {"texel_footprint", "texel_footprint_perspective", "texel_footprint_projection"};

vec3 decode_normal(uint32_t code)
{
    const float x = std::max(float(int16_t(code & 0xffff)) / 32767.0f, -1.0f), y = std::max(float(int16_t(code >> 16)) / 32767.0f, -1.0f);
    vec3 n(x, y, 1.0f - std::abs(x) - std::abs(y));
    if (n.z < 0.0f) n = vec3((1.0f - std::abs(y)) * (x >= 0 ? 1.0f : -1.0f), (1.0f - std::abs(x)) * (y >= 0 ? 1.0f : -1.0f), n.z);
    return glm::normalize(n);
}

base::Picture normals(const std::vector<std::byte>& texels, base::Size size, size_t half)
{
    base::Picture out(size, 3);
    for (size_t i = 0; i < size.area(); ++i) {
        uint32_t code;
        memcpy(&code, texels.data() + i * 8 + half * 4, 4);
        const vec3 n = decode_normal(code);
        for (int c = 0; c < 3; ++c) out.values[i * 3 + size_t(c)] = n[c];
    }
    return out;
}

/// Metres along the view axis, and the world position, from the reversed depth image.
void unproject(const base::Picture& stored, const scene::View& view, vec3 origin, base::Picture& depth, base::Picture& position)
{
    depth = base::Picture(stored.size, 1), position = base::Picture(stored.size, 3);
    for (int y = 0; y < stored.size.height; ++y)
        for (int x = 0; x < stored.size.width; ++x) {
            const float z = stored.at(x, y);
            if (z == 0.0f) continue;
            const vec2 ndc
                = vec2((float(x) + 0.5f) / float(stored.size.width), (float(y) + 0.5f) / float(stored.size.height)) * 2.0f - 1.0f;
            const vec4 h = view.world_from_clip * vec4(ndc, z, 1.0f);
            const vec3 p = vec3(h) / h.w;
            depth.at(x, y) = -(view.view_from_world * vec4(p, 1)).z;
            for (int c = 0; c < 3; ++c) position.at(x, y, c) = origin[c] + p[c];
        }
}

base::Picture first_channels(const base::Picture& in, int channels)
{
    base::Picture out(in.size, channels);
    for (size_t i = 0; i < in.size.area(); ++i)
        for (int c = 0; c < channels; ++c) out.values[i * size_t(channels) + size_t(c)] = in.values[i * size_t(in.channels) + size_t(c)];
    return out;
}

base::Picture one_channel(const base::Picture& in, int channel)
{
    base::Picture out(in.size, 1);
    for (size_t i = 0; i < in.size.area(); ++i) out.values[i] = in.values[i * size_t(in.channels) + size_t(channel)];
    return out;
}

/// Octaves: white where a texel is one to two pixels long, blue below, yellow to dark red above, each colour a factor of two.
vec3 footprint_color(float value)
{
    static constexpr float ramp[][3] = {{0.03f, 0.09f, 0.30f}, {0.08f, 0.23f, 0.52f}, {0.20f, 0.43f, 0.72f}, {0.50f, 0.69f, 0.86f},
        {0.95f, 0.95f, 0.95f}, {1.00f, 0.90f, 0.55f}, {0.99f, 0.72f, 0.30f}, {0.96f, 0.48f, 0.18f}, {0.85f, 0.22f, 0.13f},
        {0.62f, 0.05f, 0.12f}, {0.36f, 0.00f, 0.14f}};
    constexpr int one = 4, last = int(std::size(ramp)) - 1;
    if (!(value > 0.0f)) return vec3(0);
    const float octave = std::clamp(std::floor(std::log2(value)), float(-one), float(last - one));
    const float* c = ramp[one + int(octave)];
    return {c[0], c[1], c[2]};
}

} // namespace

AovCopies::AovCopies(gpu::Device& device, base::Size size, const std::set<std::string>& names)
    : names_(names)
{
    const auto make = [&](const char* image, VkFormat format, std::initializer_list<const char*> wanted_by) {
        for (const char* name : wanted_by)
            if (wants(name)) {
                images_[image] = device.image({format, size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, std::string("aov ") + image});
                return;
            }
    };
    make("depth", VK_FORMAT_D32_SFLOAT, {"depth", "position"});
    make("normal", VK_FORMAT_R32G32_UINT, {"normal", "geometric_normal"});
    make("albedo", VK_FORMAT_R8G8B8A8_SRGB, {"albedo"});
    make("surface", VK_FORMAT_R8G8B8A8_UNORM, {"surface"});
    make("primitive", VK_FORMAT_R32_UINT, {"primitive"});
    make("motion", VK_FORMAT_R32G32_SFLOAT, {"motion"});
    make("footprint", VK_FORMAT_R32G32B32A32_SFLOAT, {footprint_names[0], footprint_names[1], footprint_names[2]});
}

void AovCopies::record(gpu::PassList& passes, const shadow::GBuffer& g)
{
    const std::pair<const char*, gpu::ImageId> sources[] = {{"depth", g.depth}, {"normal", g.normal}, {"albedo", g.albedo},
        {"surface", g.surface}, {"primitive", g.primitive}, {"motion", g.motion}};
    for (const auto& [name, id] : sources)
        if (auto found = images_.find(name); found != images_.end() && id) passes.copy(id, passes.import(found->second), "copy aov");
}

void AovCopies::record_footprint(
    gpu::PassList& passes, const shadow::GBuffer& g, const scene::View& view, const shadow::parts::LightMap& map)
{
    shadow::parts::draw_texel_footprint(passes, g, view, map, passes.import(images_.at("footprint")));
}

std::map<std::string, base::Picture> AovCopies::read(gpu::Device& device, const scene::View& view, vec3 origin)
{
    std::map<std::string, base::Picture> out;
    if (images_.count("depth")) {
        base::Picture depth, position;
        unproject(device.read_back(images_["depth"]), view, origin, depth, position);
        if (wants("depth")) out["depth"] = depth;
        if (wants("position")) out["position"] = position;
    }
    if (images_.count("normal")) {
        const std::vector<std::byte> texels = device.read_back_bytes(images_["normal"]);
        if (wants("normal")) out["normal"] = normals(texels, view.size, 0);
        if (wants("geometric_normal")) out["geometric_normal"] = normals(texels, view.size, 1);
    }
    if (images_.count("albedo")) out["albedo"] = first_channels(device.read_back(images_["albedo"]), 3);
    if (images_.count("surface")) out["surface"] = first_channels(device.read_back(images_["surface"]), 2);
    if (images_.count("motion")) out["motion"] = device.read_back(images_["motion"]);
    if (wants_footprint()) {
        const base::Picture channels = device.read_back(images_["footprint"]);
        for (int c = 0; c < 3; ++c)
            if (wants(footprint_names[c])) out[footprint_names[c]] = one_channel(channels, c);
    }
    if (images_.count("primitive")) {
        const std::vector<std::byte> texels = device.read_back_bytes(images_["primitive"]);
        base::Picture ids(view.size, 1);
        for (size_t i = 0; i < ids.values.size(); ++i) {
            uint32_t id;
            memcpy(&id, texels.data() + i * 4, 4);
            ids.values[i] = id == 0xffffffffu ? -1.0f : float(id);
        }
        out["primitive"] = ids;
    }
    return out;
}

base::Picture aov_display(const std::string& name, const base::Picture& in)
{
    if (name == "normal" || name == "geometric_normal") {
        base::Picture out = in;
        for (float& v : out.values) v = 0.5f + 0.5f * v;
        return out;
    }
    if (name == "albedo" || name == "visibility") return in;
    base::Picture out(in.size, 3);
    if (std::find(std::begin(footprint_names), std::end(footprint_names), name) != std::end(footprint_names)) {
        for (size_t i = 0; i < in.size.area(); ++i)
            for (int c = 0; c < 3; ++c) out.values[i * 3 + size_t(c)] = footprint_color(in.values[i])[c];
        return out;
    }
    float largest = 1e-20f;
    for (const float v : in.values) largest = std::max(largest, std::abs(v));
    for (size_t i = 0; i < in.size.area(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const float v = in.values[i * size_t(in.channels) + std::min(c, size_t(in.channels) - 1)];
            if (name == "primitive")
                out.values[i * 3 + c] = v < 0 ? 0.0f : float((uint32_t(v) * 2654435761u >> (8 * c)) & 0xff) / 255.0f;
            else if (name == "depth")
                out.values[i * 3 + c] = v == 0 ? 0.0f : 1.0f - v / largest;
            else
                out.values[i * 3 + c] = name == "motion" || name == "position" ? 0.5f + 0.5f * v / largest : v;
        }
    return out;
}

} // namespace gnomon::lab
