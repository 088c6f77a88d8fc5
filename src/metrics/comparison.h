// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "metrics/metrics.h"

namespace gnomon::metrics {

/// From here on a pixel is fully lit; one minus this, fully dark.
inline constexpr float fully_lit = 0.999f, fully_dark = 0.001f;

/// A comparison brought to one channel: what most metrics read. Sizes of errors are taken channel by channel, so that those of opposite
/// sign do not cancel.
class Grey {
public:
    explicit Grey(const Comparison&);
    size_t size() const { return mask_.size(); }
    bool scored(size_t pixel) const { return mask_[pixel] != 0; }
    float truth(size_t pixel) const { return mean(truth_, pixel); }
    /// Not finite: the farthest end from truth.
    float test(size_t pixel) const;
    float difference(size_t pixel) const { return test(pixel) - truth(pixel); }
    /// The mean of |test - truth| over the channels, of its square, and the largest.
    struct Sizes {
        double mean = 0.0, square = 0.0, largest = 0.0;
    };
    Sizes error(size_t pixel) const;
    /// 0 where none is given.
    float variance(size_t pixel) const { return variance_.empty() ? 0.0f : mean(variance_, pixel); }

private:
    static float mean(const base::Picture& p, size_t pixel)
    {
        if (p.channels == 1) return p.values[pixel];
        return (p.values[pixel * 3] + p.values[pixel * 3 + 1] + p.values[pixel * 3 + 2]) / 3.0f;
    }
    const base::Picture &test_, &truth_, &variance_;
    const std::vector<uint8_t>& mask_;
};

// errors.cpp
double mae(const Comparison&);
double rms(const Comparison&);
double max_error(const Comparison&);
double bias(const Comparison&);
double bias_penumbra(const Comparison&);
double bias_outside(const Comparison&);
double noise(const Comparison&);
// faults.cpp
double wrong_pixels(const Comparison&);
double acne(const Comparison&);
double leak(const Comparison&);
double wrong_outside_band(const Comparison&);
double acne_outside_band(const Comparison&);
double leak_outside_band(const Comparison&);
double contact_gap(const Comparison&);
// penumbra.cpp
double penumbra_width(const Comparison&);
double banding(const Comparison&);
double grain(const Comparison&);
// edges.cpp
double edge_displacement(const Comparison&);

} // namespace gnomon::metrics
