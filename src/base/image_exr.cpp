// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"

#include <tinyexr.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>

namespace gnomon::base {

namespace {

std::string take(const char* message)
{
    std::string text = message ? message : "damaged file";
    FreeEXRErrorMessage(message);
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    return text;
}

/// Owns what tinyexr allocated.
struct Loaded {
    EXRVersion version{};
    EXRHeader header;
    EXRImage image;
    Loaded()
    {
        InitEXRHeader(&header);
        InitEXRImage(&image);
    }
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;
    ~Loaded()
    {
        FreeEXRImage(&image);
        FreeEXRHeader(&header);
    }
};

/// 0..3 for R, G, B, A; 4 for the rest.
int rank(std::string_view channel)
{
    const size_t at = std::string_view("RGBA").find(channel);
    return channel.size() == 1 && at != std::string_view::npos ? int(at) : 4;
}

void check_header(const EXRHeader& header, size_t file_size, const std::string& name)
{
    const EXRBox2i& window = header.data_window;
    const int64_t width = int64_t(window.max_x) - window.min_x + 1, height = int64_t(window.max_y) - window.min_y + 1;
    if (header.tiled || header.multipart || header.non_image)
        fail("cannot read '{}': tiled, multi-part and deep EXR files are not supported; save it as one part of scan lines", name);
    if (width < 1 || height < 1 || width > longest_side || height > longest_side || header.num_channels < 1 || header.num_channels > 64)
        fail("cannot read '{}': its EXR header gives {}x{} pixels and {} channels; at most {} a side and 64 channels are read", name, width,
            height, header.num_channels, longest_side);
    // The best of EXR's codecs (ZIP) packs at most about 1000 to 1; a larger claim is a damaged header that would cost the memory.
    if (uint64_t(width) * uint64_t(height) * uint64_t(header.num_channels) > uint64_t(file_size) * 2000 + 65536)
        fail("cannot read '{}': it has {} bytes but its header gives {}x{} pixels; the file is damaged", name, file_size, width, height);
    for (int c = 0; c < header.num_channels; ++c)
        if (header.channels[c].x_sampling != 1 || header.channels[c].y_sampling != 1)
            fail("cannot read '{}': channel '{}' is subsampled, which is not supported", name, header.channels[c].name);
}

} // namespace

void write_exr(const std::filesystem::path& path, const Picture& picture, const std::vector<std::string>& names)
{
    const int channels = picture.channels;
    if (picture.empty() || channels < 1 || names.size() != size_t(channels)
        || picture.values.size() != picture.size.area() * size_t(channels))
        fail("cannot write '{}': {} names were given for {} channels of {}x{} pixels", path.string(), names.size(), channels,
            picture.size.width, picture.size.height);
    for (const std::string& name : names)
        if (name.empty() || name.size() > 31 || std::count(names.begin(), names.end(), name) > 1)
            fail("cannot write '{}': the channel name '{}' is empty, longer than 31 letters or used twice", path.string(), name);

    std::vector<int> order(static_cast<size_t>(channels)); // the format wants channels sorted by name
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return names[size_t(a)] < names[size_t(b)]; });
    const size_t area = picture.size.area();
    std::vector<float> planes(area * size_t(channels));
    std::vector<unsigned char*> pointers;
    std::vector<EXRChannelInfo> infos(static_cast<size_t>(channels));
    std::vector<int> types(static_cast<size_t>(channels), TINYEXR_PIXELTYPE_FLOAT);
    for (size_t i = 0; i < order.size(); ++i) {
        float* plane = planes.data() + i * area;
        for (size_t p = 0; p < area; ++p) plane[p] = picture.values[p * size_t(channels) + size_t(order[i])];
        pointers.push_back(reinterpret_cast<unsigned char*>(plane));
        const std::string& name = names[size_t(order[i])];
        std::memcpy(infos[i].name, name.c_str(), name.size() + 1);
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = channels;
    header.channels = infos.data();
    header.pixel_types = header.requested_pixel_types = types.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    EXRImage image;
    InitEXRImage(&image);
    image.images = pointers.data();
    image.width = picture.size.width, image.height = picture.size.height, image.num_channels = channels;

    const char* message = nullptr;
    unsigned char* memory = nullptr;
    const size_t size = SaveEXRImageToMemory(&image, &header, &memory, &message);
    const std::unique_ptr<unsigned char, void (*)(void*)> owner(memory, std::free);
    if (size == 0) fail("cannot write '{}': {}", path.string(), take(message));
    write_file(path, std::as_bytes(std::span(memory, size)));
}

Picture read_exr(const std::filesystem::path& path, std::vector<std::string>* names)
try {
    const std::string name = path.string();
    const std::vector<std::byte> file = read_file(path);
    const auto* data = reinterpret_cast<const unsigned char*>(file.data());
    Loaded exr;
    const char* message = nullptr;
    if (ParseEXRVersionFromMemory(&exr.version, data, file.size()) != TINYEXR_SUCCESS) fail("cannot read '{}': it is no EXR file", name);
    if (exr.version.multipart || exr.version.non_image || exr.version.tiled)
        fail("cannot read '{}': tiled, multi-part and deep EXR files are not supported; save it as one part of scan lines", name);
    if (ParseEXRHeaderFromMemory(&exr.header, &exr.version, data, file.size(), &message) != TINYEXR_SUCCESS)
        fail("cannot read '{}': {}", name, take(message));
    check_header(exr.header, file.size(), name);
    for (int c = 0; c < exr.header.num_channels; ++c)
        if (exr.header.pixel_types[c] == TINYEXR_PIXELTYPE_HALF) exr.header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    // tinyexr 1.0.1 frees the image on failure but leaves its pointers, and forgets the planes unless their number is set.
    exr.image.num_channels = exr.header.num_channels;
    if (LoadEXRImageFromMemory(&exr.image, &exr.header, data, file.size(), &message) != TINYEXR_SUCCESS) {
        InitEXRImage(&exr.image);
        fail("cannot read '{}': {}", name, take(message));
    }

    const auto channels = size_t(exr.header.num_channels);
    std::vector<size_t> order(channels);
    std::iota(order.begin(), order.end(), size_t(0));
    const auto key
        = [&](size_t c) { return std::make_pair(rank(exr.header.channels[c].name), std::string_view(exr.header.channels[c].name)); };
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
    Picture picture({exr.image.width, exr.image.height}, int(channels));
    if (names) names->clear();
    for (size_t c = 0; c < channels; ++c) {
        const unsigned char* plane = exr.image.images[order[c]];
        const bool integer = exr.header.requested_pixel_types[order[c]] == TINYEXR_PIXELTYPE_UINT;
        for (size_t p = 0; p < picture.size.area(); ++p)
            picture.values[p * channels + c]
                = integer ? float(reinterpret_cast<const uint32_t*>(plane)[p]) : reinterpret_cast<const float*>(plane)[p];
        if (names) names->emplace_back(exr.header.channels[order[c]].name);
    }
    return picture;
} catch (const Error&) {
    throw;
} catch (const std::exception& e) { // tinyexr lets bad_alloc and length_error through on damaged files
    fail("cannot read '{}': the EXR file is damaged ({})", path.string(), e.what());
}

} // namespace gnomon::base
