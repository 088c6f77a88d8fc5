// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/window.h"

#include "shadow/parts/pyramid.h"
#include "src/shadow/parts/gaussian.shared.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

enum Operation : uint32_t { mean, min_max, log_mean_exp };

gpu::ImageId like(gpu::PassList& passes, gpu::ImageId image, bool with_mips)
{
    gpu::ImageDesc desc = passes.desc(image);
    desc.mips = with_mips ? pyramid_levels(desc.size) : 1, desc.name = "window";
    return passes.transient(desc);
}

gpu::ImageId slide(gpu::PassList& passes, gpu::ImageId from, int width, uint32_t axis, Operation operation, bool with_mips)
{
    const gpu::ImageDesc desc = passes.desc(from);
    const gpu::ImageId to = like(passes, from, with_mips);
    const gpu::SpecConstant constants[] = {{0, uint32_t(width)}, {1, axis}, {2, operation}};
    const uint32_t x = uint32_t(desc.size.width), y = uint32_t(desc.size.height), n = uint32_t(width);
    gpu::ComputePass pass;
    pass.name = axis == 0 ? "window along x" : "window along y";
    pass.program = &passes.device().compute_program("src/shadow/parts/window.comp", constants);
    pass.bindings = {gpu::Binding(from, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY).mips(0, 1),
        gpu::Binding(to, gpu::Use::store).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY).mips(0, 1)};
    pass.threads = axis == 0 ? gpu::Threads{y, (x + n - 1) / n, desc.layers} : gpu::Threads{x, (y + n - 1) / n, desc.layers};
    passes.compute(std::move(pass));
    return to;
}

gpu::ImageId slide_both(gpu::PassList& passes, gpu::ImageId from, int width, Operation operation, bool with_mips = false)
{
    if (width <= 1 && !with_mips) return from;
    return slide(passes, slide(passes, from, width, 0, operation, false), width, 1, operation, with_mips);
}

gpu::ImageId weigh(gpu::PassList& passes, gpu::ImageId from, const std::vector<float>& weights, int axis, bool with_mips)
{
    const gpu::ImageId to = like(passes, from, with_mips);
    shaders::GaussianConstants constants{};
    constants.width = int(weights.size()), constants.axis = axis;
    std::ranges::copy(weights, constants.weights);
    for (uint32_t layer = 0; layer < passes.desc(from).layers; ++layer) {
        constants.layer = int(layer);
        gpu::ColorTarget target{to, gpu::Load::discard};
        target.layer = layer;
        passes.fullscreen({.name = axis == 0 ? "gaussian along x" : "gaussian along y",
            .program = &passes.device().raster_program("shaders/fullscreen.vert", "src/shadow/parts/gaussian.frag"),
            .bindings = {gpu::Binding(from, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY).mips(0, 1)},
            .constants = constants,
            .colors = {target}});
    }
    return to;
}

} // namespace

gpu::ImageId window_mean(gpu::PassList& passes, gpu::ImageId values, int width, bool with_mips)
{
    return slide_both(passes, values, width, mean, with_mips);
}

gpu::ImageId window_min_max(gpu::PassList& passes, gpu::ImageId pairs, int width) { return slide_both(passes, pairs, width, min_max); }

gpu::ImageId window_log_mean_exp(gpu::PassList& passes, gpu::ImageId logs, int width, bool with_mips)
{
    return slide_both(passes, logs, width, log_mean_exp, with_mips);
}

std::vector<float> gaussian_weights(int width)
{
    std::vector<double> w(size_t(width), 0.0);
    double sum = 0;
    for (int i = 0; i < width; ++i) {
        const double x = (i + 0.5 - 0.5 * width) / (width / 6.0);
        w[size_t(i)] = std::exp(-0.5 * x * x);
        sum += w[size_t(i)];
    }
    std::vector<float> out;
    for (const double v : w) out.push_back(float(v / sum));
    return out;
}

gpu::ImageId window_gaussian(gpu::PassList& passes, gpu::ImageId values, int width, bool with_mips)
{
    if (width <= 1 && !with_mips) return values;
    const std::vector<float> weights = gaussian_weights(std::min(width, GAUSSIAN_MAX_WIDTH));
    return weigh(passes, weigh(passes, values, weights, 0, false), weights, 1, with_mips);
}

} // namespace gnomon::shadow::parts
