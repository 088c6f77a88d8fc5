// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a document come from: URIs and EXT_meshopt_compression.
#include "scene/gltf_document.h"

#include "base/file.h"

#include <meshoptimizer.h>

namespace gnomon::scene::gltf {
namespace {

int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::vector<std::byte> decode_base64(std::string_view text, const Value& uri)
{
    while (text.ends_with('=')) text.remove_suffix(1);
    std::vector<std::byte> out;
    out.reserve(text.size() / 4 * 3 + 3);
    uint32_t bits = 0, held = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) uri.bad("is no valid base64 data");
        bits = bits << 6 | uint32_t(digit);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        out.push_back(std::byte(bits >> held));
    }
    return out;
}

std::string decode_percent(std::string_view text)
{
    const auto hex = [](char c) {
        return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    };
    std::string out;
    out.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '%' && i + 2 < text.size() && hex(text[i + 1]) >= 0 && hex(text[i + 2]) >= 0;
        out += escape ? char(hex(text[i + 1]) * 16 + hex(text[i + 2])) : text[i];
        if (escape) i += 2;
    }
    return out;
}

/// Whether the path stays in the folder that it is taken from. A scheme ("http:") and a drive count as leaving.
bool stays_inside(const std::filesystem::path& path)
{
    if (path.empty() || path.has_root_path() || path.string().find_first_of(std::string_view(":\0", 2)) != std::string::npos) return false;
    for (const std::filesystem::path& part : path)
        if (part == "..") return false;
    return true;
}

enum class Mode { attributes, triangles, indices };

Mode mode_of(const Value& extension)
{
    const std::string& mode = extension.at("mode").text();
    if (mode == "ATTRIBUTES") return Mode::attributes;
    if (mode == "TRIANGLES") return Mode::triangles;
    if (mode == "INDICES") return Mode::indices;
    extension.bad("has the unknown mode '{}'", printable(mode));
}

void apply_filter(const Value& extension, std::vector<std::byte>& data, size_t count, size_t stride)
{
    const std::string filter = extension.text_or("filter", "NONE");
    if (filter == "NONE") return;
    // The decoders assume these strides without checking.
    const bool known
        = (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) || (filter == "QUATERNION" && stride == 8) || filter == "EXPONENTIAL";
    if (!known) extension.bad("has the filter '{}' with a stride of {} bytes, which is not defined", printable(filter), stride);
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(data.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(data.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(data.data(), count, stride);
}

} // namespace

std::vector<std::byte> Document::resource(const Value& uri) const
{
    const std::string_view text = uri.text();
    if (text.starts_with("data:")) {
        const size_t comma = text.find(',');
        if (comma == std::string_view::npos) uri.bad("is a data URI without data");
        if (text.substr(0, comma).ends_with(";base64")) return decode_base64(text.substr(comma + 1), uri);
        const std::string plain = decode_percent(text.substr(comma + 1));
        const auto bytes = std::as_bytes(std::span(plain));
        return {bytes.begin(), bytes.end()};
    }
    const std::filesystem::path path(decode_percent(text));
    if (!stays_inside(path)) uri.bad("('{}') must name a file beside the document or in a folder below it", printable(text));
    try {
        return base::read_file(folder_ / path);
    } catch (const base::Error& e) {
        uri.bad("cannot be read ({})", printable(e.what(), 1000));
    }
}

void Document::decompress(const Value& extension, std::vector<std::byte>& out)
{
    const Mode mode = mode_of(extension);
    const std::span<const std::byte> packed = slice(extension);
    const uint64_t count = extension.at("count").integer(), stride = extension.at("byteStride").integer();
    const bool stride_fits = mode == Mode::attributes ? stride > 0 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!stride_fits) extension.bad("has a byteStride of {}, which its mode does not allow", stride);
    if (mode == Mode::triangles && count % 3 != 0) extension.bad("holds triangles, but its count, {}, is not a multiple of 3", count);
    // The densest code is that of constant vertices, a header of 2 bits for 16 bytes; so more than this cannot be in it,
    // and a wrong count allocates nothing.
    constexpr uint64_t densest = 64, slack = 65536;
    if (count > (packed.size() * densest + slack) / stride)
        extension.bad("states {} elements of {} bytes, more than its {} bytes can hold", count, stride, packed.size());
    out.resize(count * stride);
    const auto* data = reinterpret_cast<const unsigned char*>(packed.data());
    int failed = 0;
    if (count > 0 && mode == Mode::attributes) failed = meshopt_decodeVertexBuffer(out.data(), count, stride, data, packed.size());
    if (count > 0 && mode == Mode::triangles) failed = meshopt_decodeIndexBuffer(out.data(), count, stride, data, packed.size());
    if (count > 0 && mode == Mode::indices) failed = meshopt_decodeIndexSequence(out.data(), count, stride, data, packed.size());
    if (failed != 0) extension.bad("holds broken meshopt data (code {})", failed);
    if (mode == Mode::attributes) apply_filter(extension, out, count, stride);
}

} // namespace gnomon::scene::gltf
