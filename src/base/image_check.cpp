// SPDX-License-Identifier: Apache-2.0
#include "base/image_check.h"

#include <fmt/format.h>

namespace gnomon::base {

namespace {

// DEFLATE packs at most 1032 bytes into one, and a byte of a PNG holds at most 8 pixels. A JPEG's block of 8x8 takes a bit at least, and
// with one component four times as wide as stored and another four times as high there is one block for 128 pixels.
constexpr uint64_t densest_png = 1032 * 8, densest_jpeg = 128 * 8;
constexpr int most_scans = 100; ///< progressive files have about ten; each costs a pass over all pixels, be it empty

uint8_t byte_at(std::span<const std::byte> file, size_t at) { return at < file.size() ? uint8_t(file[at]) : uint8_t(0); }

/// Two bytes; a JPEG segment's length counts them.
size_t length_at(std::span<const std::byte> file, size_t at) { return size_t(byte_at(file, at)) << 8 | byte_at(file, at + 1); }

/// Whether the codes of every table in the segment of Huffman tables at `at` are as many as the standard allows.
bool sound_tables(std::span<const std::byte> file, size_t at)
{
    const size_t end = at + length_at(file, at);
    for (at += 2; at < end;) {
        size_t codes = 0;
        for (size_t i = 1; i <= 16; ++i) codes += byte_at(file, at + i);
        if (codes > 256) return false;
        at += 17 + codes;
    }
    return true;
}

constexpr uint8_t progressive_frame = 0xc2, huffman_tables = 0xc4, start_of_image = 0xd8, end_of_image = 0xd9, start_of_scan = 0xda;

/// The tables of a segment of Huffman tables as bits: 0 to 3 of differences (DC), 4 to 7 of the others (AC).
unsigned tables_of(std::span<const std::byte> file, size_t at)
{
    unsigned out = 0;
    const size_t end = at + length_at(file, at);
    for (at += 2; at < end;) {
        const uint8_t name = byte_at(file, at);
        out |= 1u << ((name >> 4 & 1) * 4 + (name & 3));
        for (size_t i = 1, first = at; i <= 16; ++i) at += byte_at(file, first + i);
        at += 17;
    }
    return out;
}

/// The tables that the scan at `at` decodes by: of a progressive file, one kind or, where it refines differences, none.
unsigned tables_read(std::span<const std::byte> file, size_t at, bool progressive)
{
    const size_t components = byte_at(file, at + 2), rest = at + 3 + 2 * components;
    const bool first_band = byte_at(file, rest) == 0, refines = byte_at(file, rest + 2) >> 4 != 0;
    unsigned out = 0;
    for (size_t i = 0; i < components; ++i) {
        const uint8_t names = byte_at(file, at + 4 + 2 * i);
        if (!progressive || (first_band && !refines)) out |= 1u << (names >> 4 & 3);
        if (!progressive || !first_band) out |= 16u << (names & 3);
    }
    return out;
}

/// Whether every scan comes after the tables that it names: stb_image 2.27 reads others as they lie in memory, and beyond their ends.
/// A walk of its own, from segment to segment as the decoder goes: what looks like a mark within a segment would define nothing.
bool tables_precede_scans(std::span<const std::byte> file)
{
    unsigned defined = 0;
    bool progressive = false;
    for (size_t at = 2; at + 1 < file.size();) {
        const uint8_t mark = byte_at(file, at + 1);
        const bool compressed = mark == 0 || (mark >= 0xd0 && mark <= 0xd7); // a byte of data, or where decoding may begin again
        if (byte_at(file, at) != 0xff || mark == 0xff || compressed) {
            ++at;
            continue;
        }
        at += 2;
        if (mark == end_of_image) break;
        progressive |= mark == progressive_frame;
        if (mark == huffman_tables) defined |= tables_of(file, at);
        if (mark == start_of_scan && (tables_read(file, at, progressive) & ~defined) != 0) return false;
        at += length_at(file, at);
    }
    return true;
}

std::string unfit_png(std::span<const std::byte> file)
{
    bool pixels_seen = false;
    for (size_t at = 8; at + 8 <= file.size();) {
        const size_t length = length_at(file, at) << 16 | length_at(file, at + 2);
        if (length > file.size() - at - 8) return fmt::format("ends within the chunk at byte {}", at);
        const bool pixels = (length_at(file, at + 4) << 16 | length_at(file, at + 6)) == 0x49444154; // IDAT
        if (pixels && !pixels_seen && length == 0) return "begins its pixels with an empty chunk"; // the decoder copies it to nowhere
        pixels_seen |= pixels;
        at += length + 12; // length, name, data, checksum
    }
    return {};
}

std::string unfit_jpeg(std::span<const std::byte> file)
{
    // The decoder also takes files with fill bytes before their first mark, which would put this walk out of step.
    if (byte_at(file, 1) != start_of_image) return "begins with no mark of a JPEG";
    int scans = 0;
    // Segments are walked up to the first scan. From there on every mark counts: compressed data cannot hold one.
    for (size_t at = 2; at + 1 < file.size();) {
        const uint8_t mark = byte_at(file, at + 1);
        if (byte_at(file, at) != 0xff || mark == 0xff) {
            ++at;
            continue;
        }
        at += 2;
        if (mark == huffman_tables && !sound_tables(file, at)) return "has Huffman tables of more than 256 codes";
        if (mark == start_of_scan && ++scans > most_scans) return fmt::format("has more than {} scans", most_scans);
        if (scans == 0) at += length_at(file, at);
    }
    if (!tables_precede_scans(file)) return "has a scan before the Huffman tables that it names";
    return {};
}

bool is_jpeg(std::span<const std::byte> file) { return byte_at(file, 0) == 0xff; }

} // namespace

std::string unfit_form(std::span<const std::byte> file)
{
    constexpr uint8_t first_of_png = 0x89;
    return is_jpeg(file) ? unfit_jpeg(file) : byte_at(file, 0) == first_of_png ? unfit_png(file) : std::string();
}

std::string unfit_size(std::span<const std::byte> file, uint64_t pixels)
{
    if (pixels <= file.size() * (is_jpeg(file) ? densest_jpeg : densest_png)) return {};
    return fmt::format("states {} pixels, more than {} bytes can hold", pixels, file.size());
}

} // namespace gnomon::base
