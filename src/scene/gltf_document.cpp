// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_document.h"

#include "base/file.h"
#include "base/json_depth.h"

#include <algorithm>
#include <cstring>

namespace gnomon::scene::gltf {
namespace {

uint32_t little_endian(std::span<const std::byte> bytes, size_t offset)
{
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | uint32_t(bytes[offset + i]);
    return value;
}

struct Chunks {
    std::span<const std::byte> json, binary;
};

constexpr uint32_t magic_gltf = 0x46546c67, chunk_json = 0x4e4f534a, chunk_binary = 0x004e4942;

/// The parts of a .glb. Bytes after the declared length are ignored, as the format asks.
Chunks split_glb(std::span<const std::byte> content, const std::string& file)
{
    if (content.size() < 20) base::fail("{}: the file ends within its header ({} bytes); fetch or export it again", file, content.size());
    const uint32_t version = little_endian(content, 4), length = little_endian(content, 8);
    if (version != 2) base::fail("{}: binary glTF of version {} is not supported; convert it to version 2", file, version);
    if (length > content.size() || length < 20)
        base::fail("{}: the header states {} bytes, the file has {}; fetch or export it again", file, length, content.size());
    content = content.first(length);
    Chunks chunks;
    size_t at = 12;
    for (int number = 0; content.size() - at >= 8; ++number) {
        const uint32_t size = little_endian(content, at), type = little_endian(content, at + 4);
        at += 8;
        if (size > content.size() - at)
            base::fail(
                "{}: chunk {} states {} bytes, {} are left; fetch or export the file again", file, number, size, content.size() - at);
        if ((number == 0) != (type == chunk_json)) base::fail("{}: the first chunk, and no other, must be JSON; export it again", file);
        if (number == 0) chunks.json = content.subspan(at, size);
        if (number == 1 && type == chunk_binary) chunks.binary = content.subspan(at, size);
        at += size;
    }
    return chunks;
}

nlohmann::json parse(std::span<const std::byte> text, const std::string& file)
{
    const char* begin = reinterpret_cast<const char*>(text.data());
    base::check_json_depth({begin, text.size()}, file);
    try {
        return nlohmann::json::parse(begin, begin + text.size());
    } catch (const nlohmann::json::exception& e) {
        // what() begins with an identifier in brackets that helps nobody.
        const std::string_view what = e.what();
        base::fail(
            "{}: not a glTF file, its JSON is broken ({}); export the file again", file, printable(what.substr(what.find(' ') + 1), 200));
    }
}

} // namespace

Document::Document(const std::filesystem::path& path)
    : file_(printable(path.string(), 4096))
    , folder_(path.parent_path())
{
    read_container(path);
    check_header();
}

void Document::read_container(const std::filesystem::path& path)
{
    constexpr uint64_t largest = uint64_t(4) << 30; // what the 32-bit length of a .glb can state
    content_ = base::read_file(path, largest);
    if (content_.size() >= 4 && little_endian(content_, 0) == magic_gltf) {
        const Chunks chunks = split_glb(content_, file_);
        json_ = parse(chunks.json, file_);
        binary_chunk_ = chunks.binary;
    } else {
        json_ = parse(content_, file_);
        content_ = {};
    }
}

void Document::check_header() const
{
    const Value asset = root().at("asset");
    const std::string version = asset.at("version").text();
    if (!version.starts_with("2.")) base::fail("{}: glTF version {} is not supported; convert it to 2.0", file_, printable(version));
    if (const std::string least = asset.text_or("minVersion", "2.0"); least != "2.0")
        base::fail("{}: the file needs glTF {}, 2.0 is supported; export it for 2.0", file_, printable(least));
    for (const char* collection : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials", "meshes", "nodes",
             "samplers", "scenes", "skins", "textures"}) {
        const Value list = root().find(collection);
        for (size_t i = 0; i < list.size(); ++i) list[i].find(""); // fails where the element is no object
    }
    static constexpr const char* understood[] = {"KHR_mesh_quantization", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing",
        "KHR_texture_transform", "KHR_lights_punctual", "KHR_animation_pointer", "KHR_xmp_json_ld"};
    const Value required = root().find("extensionsRequired");
    for (size_t i = 0; i < required.size(); ++i) {
        const std::string& name = required[i].text();
        // Material extensions change how a surface shines, never where it is: without them the shadows are right still.
        if (name.starts_with("KHR_materials_") || std::ranges::find(understood, name) != std::end(understood)) continue;
        base::fail("{}: the file requires {}, which is not supported; convert it with gltfpack or gltf-transform", file_, printable(name));
    }
}

Value Document::element(std::string_view collection, const Value& reference) const
{
    const uint64_t i = reference.integer();
    const size_t n = count(collection);
    if (i >= n) reference.bad("refers to {}[{}], but the file has {} of them", collection, i, n);
    return element(collection, i);
}

template <class F> std::span<const std::byte> Document::remembered(std::map<size_t, Bytes>& cache, size_t key, F&& read)
{
    const auto [it, fresh] = cache.try_emplace(key);
    Bytes& entry = it->second;
    if (fresh) {
        try {
            read(entry);
        } catch (const DataError& e) {
            entry.error = e.what();
        }
    }
    if (!entry.error.empty()) throw DataError(entry.error);
    return entry.bytes;
}

std::span<const std::byte> Document::buffer(const Value& reference)
{
    const Value buffer = element("buffers", reference);
    return remembered(buffers_, reference.integer(), [&](Bytes& entry) {
        const uint64_t length = buffer.at("byteLength").integer();
        if (const Value uri = buffer.find("uri")) {
            entry.owned = resource(uri);
            entry.bytes = entry.owned;
        } else if (reference.integer() == 0 && !binary_chunk_.empty()) {
            entry.bytes = binary_chunk_;
        } else {
            buffer.bad("has no URI, and the file has no binary chunk for it");
        }
        if (entry.bytes.size() < length) buffer.bad("states {} bytes, but {} are there", length, entry.bytes.size());
        entry.bytes = entry.bytes.first(length);
    });
}

std::span<const std::byte> Document::slice(const Value& view)
{
    const std::span<const std::byte> bytes = buffer(view.at("buffer"));
    const uint64_t offset = view.integer_or("byteOffset", 0), length = view.at("byteLength").integer();
    if (offset > bytes.size() || length > bytes.size() - offset)
        view.bad("covers bytes {} to {} of a buffer of {} bytes", offset, offset + length, bytes.size());
    return bytes.subspan(offset, length);
}

std::span<const std::byte> Document::view(const Value& reference)
{
    const Value view = element("bufferViews", reference);
    const Value compressed = view.extension("EXT_meshopt_compression");
    if (!compressed) return slice(view);
    return remembered(decompressed_, reference.integer(), [&](Bytes& entry) {
        decompress(compressed, entry.owned);
        entry.bytes = entry.owned;
    });
}

void Document::warn(std::string sentence)
{
    constexpr size_t most = 50; // a file broken all over says the same thing a thousand times
    if (warnings_.size() < most)
        warnings_.push_back(std::move(sentence));
    else
        ++unlisted_warnings_;
}

std::vector<std::string> Document::take_warnings()
{
    if (unlisted_warnings_ > 0) warnings_.push_back(fmt::format("{}: {} further warnings", file_, unlisted_warnings_));
    unlisted_warnings_ = 0;
    return std::exchange(warnings_, {});
}

} // namespace gnomon::scene::gltf
