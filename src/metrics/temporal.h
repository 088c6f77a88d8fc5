// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "metrics/metrics.h"

#include <array>
#include <functional>
#include <vector>

// How the error of a technique changes from frame to frame: what a truth that is exact in every frame leaves of the picture's own motion.
namespace gnomon::metrics {

/// A frame of a sequence. All frames have one size.
struct SequenceFrame {
    Comparison shown;
    const base::Picture& position; ///< 3 channels: of the surface at each pixel's centre, world space
    const base::Picture& normal; ///< 3 channels: geometric, unit
    const base::Picture& pixel_width; ///< 1 channel: of a pixel there, in the units of `position`
    /// Where a point of the world falls in this frame, in pixels (centres at +0.5); not finite where it falls nowhere.
    std::function<std::array<float, 2>(std::array<float, 3>)> pixel_of;
};

/// The error e = test - truth is followed along the surfaces: each scored pixel's point is looked up in the frames before and after. At a
/// point, e is the mean of the scored pixels around its place that show the same surface, under a Gaussian of 1.5 pixels about that very
/// place: a thin error that stays where it is on the surface is sampled by another pixel grid in each frame, and only its mean stays the
/// same (docs/results.md, "Sequences", has what is left of it). With the changes d1 = e_t - e_(t-1) and d2 = e_(t+1) - e_t:
///   flicker    mean of what one frame changes and the next takes back: min(|d1|, |d2|) where the signs differ, else 0
///   swimming   mean of what lasts, |d1 + d2| / 2. With flicker it adds up to the mean change, (|d1| + |d2|) / 2
///   popping    the largest mean change of a frame beyond the median frame's
struct Temporal {
    double flicker = 0, swimming = 0, popping = 0;
    double noise = 0; ///< what the truth's variance alone adds to the mean change at most: frames whose truths err independently
    std::vector<double> change; ///< mean |d1| in each frame after the first
    size_t followed = 0; ///< points that were found before and after, all frames together
    size_t lost = 0; ///< points that were not: out of the picture, or hidden
    size_t moved = 0; ///< points whose surface moved
    base::Picture map; ///< 1 channel: mean change at each pixel, over the frames in which it was followed
};

/// At least three frames. `fixed`: all are of one view, where a point whose position differs has moved and is left out.
Temporal measure_sequence(const std::vector<SequenceFrame>&, bool fixed);

/// What `measure_sequence` adds to a run, for lists of metrics: their `measure` is null, since one picture has none of them.
const std::vector<Metric>& temporal_metrics();

} // namespace gnomon::metrics
