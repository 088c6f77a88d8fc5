// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/gpu/windows.shared.h"
#include "tests/window_twin.h"

#include "gpu/device.h"
#include "gpu/pass_list.h"

#include <cstring>
#include <random>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::tests {

inline gpu::Image upload_layers(gpu::Device& device, const Layers& layers)
{
    constexpr VkFormat formats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_UNDEFINED, VK_FORMAT_R32G32B32A32_SFLOAT};
    gpu::Image image = device.image(
        {formats[layers[0].channels - 1], layers[0].size, uint32_t(layers.size()), 1, VK_SAMPLE_COUNT_1_BIT, false, "layers"});
    for (uint32_t i = 0; i < layers.size(); ++i) device.upload(image, std::as_bytes(std::span(layers[i].values)), i);
    return image;
}

/// Submits the list with a last pass that runs a compute shader once per case:
///   layout(local_size_x = 64) in;
///   layout(set = 0, binding = 0, scalar) readonly buffer In { Case cases[]; };
///   layout(set = 0, binding = 1, scalar) writeonly buffer Out { Result results[]; };
/// and `images` from binding 2 on; it returns at once where gl_GlobalInvocationID.x >= cases.length().
template <class Result, class Case>
std::vector<Result> run_image_cases(gpu::PassList list, std::string_view shader, const std::vector<Case>& cases,
    const std::vector<gpu::Binding>& images, gpu::Constants constants = {})
{
    gpu::Device& device = list.device();
    gpu::Buffer in = device.buffer({cases.size() * sizeof(Case), 0, gpu::Memory::device, "cases"});
    gpu::Buffer out = device.buffer({cases.size() * sizeof(Result), 0, gpu::Memory::device, "results"});
    device.upload(in, std::as_bytes(std::span(cases)));
    gpu::ComputePass pass{"cases", &device.compute_program(shader),
        {{list.import(in), gpu::Use::load}, {list.import(out), gpu::Use::store}}, std::move(constants), {uint32_t(cases.size()), 1, 1}};
    pass.bindings.insert(pass.bindings.end(), images.begin(), images.end());
    list.compute(std::move(pass));
    device.submit(std::move(list));
    const std::vector<std::byte> bytes = device.read_back(out);
    std::vector<Result> results(cases.size());
    std::memcpy(results.data(), bytes.data(), bytes.size());
    return results;
}

/// Windows of all sizes, also empty, inside one texel, with ends between texels, and reaching over the rim.
inline std::vector<shaders::WindowCase> random_windows(base::Size size, int layers, int count, uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const vec2 extent(size.width, size.height);
    std::vector<shaders::WindowCase> cases;
    for (int i = 0; i < count; ++i) {
        const vec2 middle = extent * (1.2f * vec2(unit(random), unit(random)) - 0.1f);
        // sides from a hundredth of a texel to more than the image, evenly over the logarithms
        const vec2 side = 0.01f * glm::pow(150.0f * extent, vec2(unit(random), unit(random)));
        shaders::WindowCase c{int(random() % uint32_t(layers)), middle - 0.5f * side, middle + 0.5f * side};
        if (i % 4 == 1) c.lo = glm::floor(c.lo), c.hi = glm::floor(c.hi);
        if (i % 16 == 2) c.hi = c.lo;
        cases.push_back(c);
    }
    cases.push_back({0, vec2(0), extent});
    cases.push_back({layers - 1, vec2(-1e9f), vec2(1e9f)});
    cases.push_back({0, extent + 10.0f, extent + 20.0f});
    return cases;
}

/// 1 x 1, 1 x n, powers of two and others.
inline constexpr base::Size window_sizes[] = {{1, 1}, {1, 37}, {53, 1}, {64, 64}, {129, 75}, {6, 200}};

} // namespace gnomon::tests
