// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

#define FORMAT(name, channels, bytes, numeric)                                                                                             \
    FormatInfo { VK_FORMAT_##name, #name, channels, bytes, Numeric::numeric }
constexpr FormatInfo formats[] = {FORMAT(R8_UNORM, 1, 1, unorm), FORMAT(R8_SNORM, 1, 1, snorm), FORMAT(R8_UINT, 1, 1, uint),
    FORMAT(R8_SINT, 1, 1, sint), FORMAT(R8_SRGB, 1, 1, srgb), FORMAT(R8G8_UNORM, 2, 1, unorm), FORMAT(R8G8_SNORM, 2, 1, snorm),
    FORMAT(R8G8_UINT, 2, 1, uint), FORMAT(R8G8B8A8_UNORM, 4, 1, unorm), FORMAT(R8G8B8A8_SNORM, 4, 1, snorm),
    FORMAT(R8G8B8A8_UINT, 4, 1, uint), FORMAT(R8G8B8A8_SINT, 4, 1, sint), FORMAT(R8G8B8A8_SRGB, 4, 1, srgb),
    FORMAT(B8G8R8A8_UNORM, 4, 1, unorm), FORMAT(B8G8R8A8_SRGB, 4, 1, srgb), FORMAT(R16_UNORM, 1, 2, unorm), FORMAT(R16_SNORM, 1, 2, snorm),
    FORMAT(R16_UINT, 1, 2, uint), FORMAT(R16_SFLOAT, 1, 2, sfloat), FORMAT(R16G16_UNORM, 2, 2, unorm), FORMAT(R16G16_SNORM, 2, 2, snorm),
    FORMAT(R16G16_UINT, 2, 2, uint), FORMAT(R16G16_SFLOAT, 2, 2, sfloat), FORMAT(R16G16B16A16_UNORM, 4, 2, unorm),
    FORMAT(R16G16B16A16_SNORM, 4, 2, snorm), FORMAT(R16G16B16A16_UINT, 4, 2, uint), FORMAT(R16G16B16A16_SFLOAT, 4, 2, sfloat),
    FORMAT(R32_UINT, 1, 4, uint), FORMAT(R32_SINT, 1, 4, sint), FORMAT(R32_SFLOAT, 1, 4, sfloat), FORMAT(R32G32_UINT, 2, 4, uint),
    FORMAT(R32G32_SINT, 2, 4, sint), FORMAT(R32G32_SFLOAT, 2, 4, sfloat), FORMAT(R32G32B32A32_UINT, 4, 4, uint),
    FORMAT(R32G32B32A32_SINT, 4, 4, sint), FORMAT(R32G32B32A32_SFLOAT, 4, 4, sfloat), FORMAT(B10G11R11_UFLOAT_PACK32, 3, 0, sfloat),
    FORMAT(A2B10G10R10_UNORM_PACK32, 4, 0, unorm), FORMAT(D16_UNORM, 1, 2, unorm), FORMAT(D32_SFLOAT, 1, 4, sfloat),
    FORMAT(X8_D24_UNORM_PACK32, 1, 0, unorm), FORMAT(D24_UNORM_S8_UINT, 1, 0, unorm), FORMAT(D32_SFLOAT_S8_UINT, 1, 4, sfloat),
    FORMAT(S8_UINT, 1, 1, uint)};
#undef FORMAT

/// A float of `mantissa` bits under a 5-bit exponent, without sign (the halves' and the packed 11/10-bit floats' magnitude).
float small_float(uint32_t bits, int mantissa)
{
    const uint32_t exponent = bits >> mantissa & 31, fraction = bits & ((1u << mantissa) - 1);
    const float scaled = float(fraction) / float(1u << mantissa);
    if (exponent == 31) return fraction ? std::nanf("") : INFINITY;
    return exponent == 0 ? std::ldexp(scaled, -14) : std::ldexp(1.0f + scaled, int(exponent) - 15);
}

float from_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

float decode(const FormatInfo& info, uint32_t bits)
{
    const uint32_t width = info.channel_bytes * 8u;
    const float largest = float(width == 32 ? 0xffffffffu : (1u << width) - 1);
    const int32_t with_sign = int32_t(bits << (32 - width)) >> (32 - width);
    switch (info.numeric) {
    case Numeric::unorm:
        return float(bits) / largest;
    case Numeric::srgb:
        return from_srgb(float(bits) / largest);
    case Numeric::snorm:
        return std::max(float(with_sign) / float((1u << (width - 1)) - 1), -1.0f);
    case Numeric::uint:
        return float(bits);
    case Numeric::sint:
        return float(with_sign);
    case Numeric::sfloat:
        break;
    }
    if (width == 32) return std::bit_cast<float>(bits);
    const float magnitude = small_float(bits & 0x7fff, 10);
    return bits & 0x8000 ? -magnitude : magnitude;
}

void decode_packed(VkFormat format, uint32_t bits, float* out)
{
    if (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32) {
        out[0] = small_float(bits & 0x7ff, 6), out[1] = small_float(bits >> 11 & 0x7ff, 6), out[2] = small_float(bits >> 22, 5);
    } else if (format == VK_FORMAT_A2B10G10R10_UNORM_PACK32) {
        for (int c = 0; c < 3; ++c) out[c] = float(bits >> (10 * c) & 0x3ff) / 1023.0f;
        out[3] = float(bits >> 30) / 3.0f;
    } else {
        out[0] = float(bits & 0xffffff) / float(0xffffff);
    }
}

} // namespace

const FormatInfo& format_info(VkFormat format)
{
    for (const auto& info : formats)
        if (info.format == format) return info;
    throw std::logic_error("VkFormat " + std::to_string(int(format)) + " is not in the table of src/gpu/formats.cpp; add its line there");
}

uint64_t texel_bytes(VkFormat format)
{
    const auto& info = format_info(format);
    return info.channel_bytes ? uint64_t(info.channels) * info.channel_bytes : 4;
}

bool has_stencil(VkFormat format)
{
    return format == VK_FORMAT_D24_UNORM_S8_UINT || format == VK_FORMAT_D32_SFLOAT_S8_UINT || format == VK_FORMAT_S8_UINT;
}

bool is_depth(VkFormat format)
{
    return format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_X8_D24_UNORM_PACK32 || format == VK_FORMAT_D32_SFLOAT
        || has_stencil(format);
}

bool is_integer(VkFormat format)
{
    const Numeric numeric = format_info(format).numeric;
    return numeric == Numeric::uint || numeric == Numeric::sint;
}

VkImageAspectFlags main_aspect(VkFormat format)
{
    if (format == VK_FORMAT_S8_UINT) return VK_IMAGE_ASPECT_STENCIL_BIT;
    return is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkImageAspectFlags aspects_of(VkFormat format)
{
    return main_aspect(format) | (has_stencil(format) ? VkImageAspectFlags(VK_IMAGE_ASPECT_STENCIL_BIT) : 0);
}

base::Picture to_picture(VkFormat format, Size size, std::span<const std::byte> texels)
{
    const auto& info = format_info(format);
    base::Picture picture(size, info.channels);
    const bool swapped = format == VK_FORMAT_B8G8R8A8_UNORM || format == VK_FORMAT_B8G8R8A8_SRGB;
    FormatInfo alpha = info; // alpha is never encoded
    if (info.numeric == Numeric::srgb) alpha.numeric = Numeric::unorm;
    const size_t stride = texel_bytes(format);
    for (size_t i = 0; i < size.area(); ++i) {
        float* out = &picture.values[i * info.channels];
        const std::byte* in = &texels[i * stride];
        if (!info.channel_bytes) {
            uint32_t bits;
            std::memcpy(&bits, in, 4);
            decode_packed(format, bits, out);
            continue;
        }
        for (int c = 0; c < info.channels; ++c) {
            uint32_t bits = 0; // little-endian, as every device here
            std::memcpy(&bits, in + c * info.channel_bytes, info.channel_bytes);
            out[c] = decode(c == 3 ? alpha : info, bits);
        }
        if (swapped) std::swap(out[0], out[2]);
    }
    return picture;
}

} // namespace gnomon::gpu
