// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/pass_list.h"

#include <vector>

// Averages, minima and maxima of the n x n texels around every texel of every layer. Windows of an odd width are centred on their texel;
// of an even one they reach half a texel further to the left and top: output i covers [i - n/2, i - n/2 + n). Windows that reach over
// the image's rim repeat its last texel, as a clamping sampler does. The results have one mip, or all of them, the others to be filled.
namespace gnomon::shadow::parts {

/// Box means. Time does not depend on the width (2 to 4 times a copy's
/// bytes an axis; on lavapipe 7 to 12 ms an axis for 1024 x 1024 texels of rg32f at any width from 3 to 127). Sums are made of at most
/// 2n - 1 additions of like sign and no subtraction, so values of any magnitude may stand side by side.
gpu::ImageId window_mean(gpu::PassList&, gpu::ImageId values, int width, bool with_mips = false);

/// x: minimum of x, y: maximum of y (of pairs (v, v) or of (min, max) made before).
gpu::ImageId window_min_max(gpu::PassList&, gpu::ImageId pairs, int width);

/// log(mean(exp(x))) of one channel: box means of numbers whose exponentials no format holds.
gpu::ImageId window_log_mean_exp(gpu::PassList&, gpu::ImageId logs, int width, bool with_mips = false);

/// Means under a Gaussian of standard deviation width / 6, cut off at the window. Two full-screen passes a layer, time linear in the
/// width. `width` <= 127.
gpu::ImageId window_gaussian(gpu::PassList&, gpu::ImageId values, int width, bool with_mips = false);

/// The weights of window_gaussian along one axis: width of them, sum 1.
std::vector<float> gaussian_weights(int width);

} // namespace gnomon::shadow::parts
