// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_material.h"

#include "base/image_file.h"

#include <cstring>

namespace gnomon::scene::gltf {
namespace {

bool begins_with(std::span<const std::byte> file, std::string_view bytes)
{
    return file.size() >= bytes.size() && std::memcmp(file.data(), bytes.data(), bytes.size()) == 0;
}

Wrap wrap_of(uint64_t code, const Value& sampler)
{
    switch (code) {
    case 10497:
        return Wrap::repeat;
    case 33648:
        return Wrap::mirror;
    case 33071:
        return Wrap::clamp;
    default:
        sampler.bad("has the unknown wrapping {}", code);
    }
}

void read_sampler(const Value& sampler, Texture& out)
{
    constexpr uint64_t nearest = 9728, linear = 9729, repeat = 10497;
    out.linear = sampler.integer_or("magFilter", linear) != nearest;
    out.wrap_u = wrap_of(sampler.integer_or("wrapS", repeat), sampler);
    out.wrap_v = wrap_of(sampler.integer_or("wrapT", repeat), sampler);
}

} // namespace

void decode_image(std::span<const std::byte> file, const Value& image, Texture& out)
{
    // The formats of glTF; those decoders that it has no use for are not shown hostile files.
    if (!begins_with(file, "\x89PNG") && !begins_with(file, "\xff\xd8\xff")) image.bad("is neither a PNG nor a JPEG");
    base::Pixels8 pixels;
    try {
        pixels = base::decode_rgba8(file, image.path());
    } catch (const base::Error& e) {
        image.bad("is broken ({})", e.what());
    }
    out.width = pixels.width;
    out.height = pixels.height;
    out.rgba = std::move(pixels.rgba);
}

int Materials::texture_index(const Value& reference, bool srgb)
{
    const Value texture = document_.element("textures", reference);
    const Value source = texture.find("source");
    if (!source) texture.bad("has no PNG or JPEG image (convert it with gltf-transform)");
    const Value image = document_.element("images", source);
    Texture out;
    out.srgb = srgb;
    out.name = texture.text_or("name", image.text_or("name", image.path()));
    if (const Value index = texture.find("sampler")) read_sampler(document_.element("samplers", index), out);
    const auto [it, fresh] = textures_.try_emplace({source.integer(), srgb, out.linear, out.wrap_u, out.wrap_v}, -1);
    if (!fresh) return it->second;
    if (const Value uri = image.find("uri"))
        decode_image(document_.resource(uri), image, out);
    else
        decode_image(document_.view(image.at("bufferView")), image, out);
    constexpr uint64_t most = uint64_t(4) << 30; // a thousand images may name one large buffer view
    texture_bytes_ += out.rgba.size();
    if (texture_bytes_ > most) image.bad("does not fit: the textures would take more than {} bytes", most);
    it->second = int(scene_.textures.size());
    scene_.textures.push_back(std::move(out));
    return it->second;
}

} // namespace gnomon::scene::gltf
