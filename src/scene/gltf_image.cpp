// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_material.h"

#include <stb_image.h>

#include <climits>
#include <cstring>
#include <memory>

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

} // namespace

void decode_image(std::span<const std::byte> file, const Value& image, Texture& out)
{
    // The formats of glTF; the decoders of stb for its other formats have known faults on hostile files.
    if (!begins_with(file, "\x89PNG") && !begins_with(file, "\xff\xd8\xff")) image.bad("is neither a PNG nor a JPEG");
    const auto* data = reinterpret_cast<const stbi_uc*>(file.data());
    int width = 0, height = 0, channels = 0;
    constexpr int widest = 16384;
    if (file.size() > INT_MAX || !stbi_info_from_memory(data, int(file.size()), &width, &height, &channels))
        image.bad("has a broken header");
    // DEFLATE packs at most 1032 bytes into one, and a byte holds at most 8 pixels: a larger picture is not in the file.
    if (width > widest || height > widest || uint64_t(width) * uint64_t(height) > file.size() * uint64_t(1032 * 8))
        image.bad("claims {} x {} pixels in {} bytes; at most {} a side are supported", width, height, file.size(), widest);
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, int(file.size()), &width, &height, &channels, 4), stbi_image_free);
    if (!pixels) image.bad("cannot be decoded ({})", stbi_failure_reason());
    out.width = width;
    out.height = height;
    out.rgba.assign(pixels.get(), pixels.get() + size_t(width) * size_t(height) * 4);
}

int Materials::texture_index(const Value& reference, bool srgb)
{
    const Value texture = document_.element("textures", reference);
    const auto [it, fresh] = textures_.try_emplace({reference.integer(), srgb}, -1);
    if (!fresh) return it->second;
    document_.recover("it is left out", [&] {
        const Value source = texture.find("source");
        if (!source) texture.bad("has no PNG or JPEG image (convert it with gltf-transform)");
        const Value image = document_.element("images", source);
        Texture out;
        out.srgb = srgb;
        out.name = texture.text_or("name", image.text_or("name", fmt::format("texture {}", reference.integer())));
        if (const Value index = texture.find("sampler")) {
            const Value sampler = document_.element("samplers", index);
            constexpr uint64_t nearest = 9728, linear = 9729, repeat = 10497;
            out.linear = sampler.integer_or("magFilter", linear) != nearest;
            out.wrap_u = wrap_of(sampler.integer_or("wrapS", repeat), sampler);
            out.wrap_v = wrap_of(sampler.integer_or("wrapT", repeat), sampler);
        }
        if (const Value uri = image.find("uri"))
            decode_image(document_.resource(uri), image, out);
        else
            decode_image(document_.view(image.at("bufferView")), image, out);
        it->second = int(scene_.textures.size());
        scene_.textures.push_back(std::move(out));
    });
    return it->second;
}

} // namespace gnomon::scene::gltf
