// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace gnomon::base {

/// Width and height in pixels.
struct Size {
    int width = 0, height = 0;
    bool operator==(const Size&) const = default;
    size_t area() const { return size_t(width) * size_t(height); }
};

/// A picture in memory: linear float values, row 0 on top, channels interleaved.
struct Picture {
    Size size;
    int channels = 0;
    std::vector<float> values; ///< size.area() * channels

    Picture() = default;
    Picture(Size s, int channel_count, float value = 0.0f)
        : size(s)
        , channels(channel_count)
        , values(s.area() * size_t(channel_count), value)
    {
    }
    float& at(int x, int y, int c = 0) { return values[(size_t(y) * size_t(size.width) + size_t(x)) * size_t(channels) + size_t(c)]; }
    float at(int x, int y, int c = 0) const { return const_cast<Picture*>(this)->at(x, y, c); }
    bool empty() const { return values.empty(); }
};

} // namespace gnomon::base
