// SPDX-License-Identifier: Apache-2.0
#include "lab/render_tiles.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

template <class T>
void paste_rows(std::vector<T>& whole, base::Size size, const std::vector<T>& part, const scene::Crop& crop, size_t channels)
{
    whole.resize(size.area() * channels);
    const size_t row = size_t(crop.size.width) * channels;
    for (int y = 0; y < crop.size.height; ++y) {
        const size_t to = (size_t(crop.top + y) * size_t(size.width) + size_t(crop.left)) * channels;
        std::copy_n(part.begin() + std::ptrdiff_t(size_t(y) * row), row, whole.begin() + std::ptrdiff_t(to));
    }
}

void paste_picture(base::Picture& whole, base::Size size, const base::Picture& part, const scene::Crop& crop)
{
    if (part.empty()) return;
    whole.size = size, whole.channels = part.channels;
    paste_rows(whole.values, size, part.values, crop, size_t(part.channels));
}

/// Parts follow one another, so that their times add up, and their variances.
void add_times(Rendered& whole, const Rendered& part)
{
    for (const PassStats& p : part.passes) {
        const auto same = std::find_if(whole.passes.begin(), whole.passes.end(), [&](const PassStats& w) { return w.name == p.name; });
        if (same == whole.passes.end()) {
            whole.passes.push_back(p);
            continue;
        }
        same->ms += p.ms, same->deviation = std::hypot(same->deviation, p.deviation), same->count += p.count;
    }
    whole.technique_ms += part.technique_ms, whole.technique_least_ms += part.technique_least_ms;
    whole.technique_deviation = std::hypot(whole.technique_deviation, part.technique_deviation);
}

} // namespace

void paste(Rendered& whole, base::Size size, const Rendered& part, const scene::Crop& crop)
{
    paste_picture(whole.radiance, size, part.radiance, crop);
    whole.images.resize(part.images.size());
    for (size_t i = 0; i < part.images.size(); ++i) paste_picture(whole.images[i], size, part.images[i], crop);
    paste_rows(whole.primitive, size, part.primitive, crop, 1);
    for (const auto& [name, picture] : part.aovs) paste_picture(whole.aovs[name], size, picture, crop);
    for (const auto& [name, count] : part.counts) whole.counts[name] += count;
    whole.technique_bytes = std::max(whole.technique_bytes, part.technique_bytes);
    add_times(whole, part);
}

} // namespace gnomon::lab
