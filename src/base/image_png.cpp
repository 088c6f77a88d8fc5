// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/image_check.h"
#include "base/image_file.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <memory>

// Static, because other libraries in the same program carry their own copies of stb.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_LINEAR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace gnomon::base {

static_assert(longest_side == STBI_MAX_DIMENSIONS);

namespace {

double srgb_from_linear(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055; }
double linear_from_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

uint8_t to_byte(float value, bool srgb)
{
    if (!(value > 0.0f)) return 0; // also NaN
    const double v = std::min(1.0, double(value));
    return uint8_t((srgb ? srgb_from_linear(v) : v) * 255.0 + 0.5);
}

bool is_alpha(int channel, int channels) { return channels == 4 && channel == 3; }

struct StbFree {
    void operator()(void* p) const { stbi_image_free(p); }
};

struct Encoded {
    const stbi_uc* data;
    int size, width, height, channels;
};

/// Looks at the header only.
Encoded inspect(std::span<const std::byte> file, std::string_view name)
{
    Encoded e{reinterpret_cast<const stbi_uc*>(file.data()), 0, 0, 0, 0};
    if (file.size() > size_t(INT_MAX)) fail("the picture '{}' has {} bytes; at most {} can be read", name, file.size(), INT_MAX);
    e.size = int(file.size());
    const auto refuse = [&](const std::string& fault) {
        if (!fault.empty()) fail("cannot decode the picture '{}': it {}; the file is damaged", name, fault);
    };
    refuse(unfit_form(file));
    if (!stbi_info_from_memory(e.data, e.size, &e.width, &e.height, &e.channels))
        fail("cannot decode the picture '{}': {}; give a PNG or JPEG file", name, stbi_failure_reason());
    if (e.width <= 0 || e.height <= 0 || e.width > longest_side || e.height > longest_side)
        fail("the picture '{}' has {}x{} pixels; at most {} a side are read", name, e.width, e.height, longest_side);
    refuse(unfit_size(file, uint64_t(e.width) * uint64_t(e.height)));
    return e;
}

[[noreturn]] void damaged(std::string_view name)
{
    fail("cannot decode the picture '{}': {}; the file is damaged or of an unknown kind", name, stbi_failure_reason());
}

} // namespace

void write_png(const std::filesystem::path& path, const Picture& picture, Encoding encoding)
{
    const auto [width, height] = picture.size;
    const int channels = picture.channels;
    if (width <= 0 || height <= 0 || width > longest_side || height > longest_side || (channels != 1 && channels != 3 && channels != 4)
        || picture.values.size() != picture.size.area() * size_t(channels))
        fail("cannot write '{}': a PNG needs 1, 3 or 4 channels and 1 to {} pixels a side, not {} channels and {}x{}", path.string(),
            longest_side, channels, width, height);
    // Neighbours are often equal (visibility, background), which saves the power function.
    std::vector<uint8_t> bytes(picture.values.size());
    for (int c = 0; c < channels; ++c) {
        const bool srgb = encoding == Encoding::srgb && !is_alpha(c, channels);
        float last = 0.0f;
        uint8_t code = 0;
        for (size_t i = size_t(c); i < bytes.size(); i += size_t(channels)) {
            if (picture.values[i] != last) last = picture.values[i], code = to_byte(last, srgb);
            bytes[i] = code;
        }
    }
    std::vector<std::byte> file;
    const auto append = [](void* out, void* data, int size) {
        const auto* begin = static_cast<const std::byte*>(data);
        static_cast<std::vector<std::byte>*>(out)->insert(static_cast<std::vector<std::byte>*>(out)->end(), begin, begin + size);
    };
    if (size_t(width) * size_t(height) * size_t(channels) > size_t(INT_MAX) / 2
        || !stbi_write_png_to_func(append, &file, width, height, channels, bytes.data(), width * channels))
        fail("cannot write '{}': {}x{} pixels are too many for one PNG; choose a smaller size", path.string(), width, height);
    write_file(path, file);
}

Picture read_png(const std::filesystem::path& path, Encoding encoding)
{
    const std::string name = path.string();
    const std::vector<std::byte> file = read_file(path, uint64_t(INT_MAX));
    const Encoded e = inspect(file, name);
    const int channels = e.channels == 2 ? 4 : e.channels;
    Picture picture({e.width, e.height}, channels);
    int w = 0, h = 0, in_file = 0;
    const auto fill = [&](const auto* values, double top) {
        if (!values || w != e.width || h != e.height) damaged(name);
        std::vector<float> decoded(size_t(top) + 1), plain(size_t(top) + 1);
        for (size_t i = 0; i < decoded.size(); ++i) {
            plain[i] = float(double(i) / top);
            decoded[i] = encoding == Encoding::srgb ? float(linear_from_srgb(double(i) / top)) : plain[i];
        }
        for (size_t i = 0; i < picture.values.size(); ++i)
            picture.values[i] = is_alpha(int(i % size_t(channels)), channels) ? plain[values[i]] : decoded[values[i]];
    };
    if (stbi_is_16_bit_from_memory(e.data, e.size)) {
        const std::unique_ptr<stbi_us, StbFree> values(stbi_load_16_from_memory(e.data, e.size, &w, &h, &in_file, channels));
        fill(values.get(), 65535.0);
    } else {
        const std::unique_ptr<stbi_uc, StbFree> values(stbi_load_from_memory(e.data, e.size, &w, &h, &in_file, channels));
        fill(values.get(), 255.0);
    }
    return picture;
}

Pixels8 decode_rgba8(std::span<const std::byte> file, std::string_view name)
{
    const Encoded e = inspect(file, name);
    Pixels8 result;
    int in_file = 0;
    const std::unique_ptr<stbi_uc, StbFree> values(stbi_load_from_memory(e.data, e.size, &result.width, &result.height, &in_file, 4));
    if (!values) damaged(name);
    result.rgba.assign(values.get(), values.get() + size_t(result.width) * size_t(result.height) * 4);
    return result;
}

} // namespace gnomon::base
