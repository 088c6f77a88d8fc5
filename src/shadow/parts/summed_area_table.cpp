// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/summed_area_table.h"

#include "base/error.h"
#include "gpu/device.h"
#include "shadow/parts/image_formats.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

/// One scan: rows of `from` to columns of the result, which has the entry 0 before them.
gpu::ImageId scan(gpu::PassList& passes, const char* name, gpu::ImageId from, VkFormat format, const char* shader, gpu::Constants constants)
{
    const gpu::SpecConstant channels[] = {{0, uint32_t(gpu::texel_bytes(format) / 4)}};
    const gpu::ImageDesc desc = passes.desc(from);
    const gpu::ImageId to = passes.transient(
        {format, {desc.size.height, desc.size.width + 1}, desc.layers, 1, VK_SAMPLE_COUNT_1_BIT, false, "summed-area table"});
    passes.compute(
        {name, &passes.device().compute_program(shader, channels), {gpu::Binding(from, gpu::Use::sample).mips(0, 1), {to, gpu::Use::store}},
            std::move(constants), {uint32_t(desc.size.height) * 32, desc.layers, 1}});
    return to;
}

} // namespace

gpu::ImageId build_float_sums(gpu::PassList& passes, gpu::ImageId from, int channels, vec4 centre)
{
    const VkFormat format = float_format(channels);
    const char* shader = "src/shadow/parts/summed_area_float.comp";
    const gpu::ImageId rows = scan(passes, "sum rows", from, format, shader, centre);
    return scan(passes, "sum columns", rows, format, shader, vec4(0));
}

gpu::ImageId build_integer_sums(gpu::PassList& passes, gpu::ImageId from, int channels, int bits)
{
    if (bits < 1 || bits > 24) base::fail("an integer summed-area table has 1 to 24 bits a value, not {}; see integer_sum_bits", bits);
    const VkFormat format = integer_format(channels);
    const gpu::ImageId rows = scan(passes, "sum rows", from, format, "src/shadow/parts/summed_area_quantise.comp", float((1 << bits) - 1));
    return scan(passes, "sum columns", rows, format, "src/shadow/parts/summed_area_integer.comp", {});
}

gpu::ImageId build_word_sums(gpu::PassList& passes, const std::vector<gpu::Binding>& sources, gpu::Size size, uint32_t layers,
    const char* rows, gpu::Constants constants)
{
    const VkFormat format = VK_FORMAT_R32G32B32A32_UINT;
    const gpu::ImageId sums
        = passes.transient({format, {size.height, size.width + 1}, layers, 1, VK_SAMPLE_COUNT_1_BIT, false, "summed-area table"});
    std::vector<gpu::Binding> bindings = sources;
    bindings.emplace_back(sums, gpu::Use::store);
    const gpu::SpecConstant channels[] = {{0, 4}};
    passes.compute({"sum rows", &passes.device().compute_program(rows, channels), std::move(bindings), std::move(constants),
        {uint32_t(size.height) * 32, layers, 1}});
    return scan(passes, "sum columns", sums, format, "src/shadow/parts/summed_area_integer.comp", {});
}

int integer_sum_bits(double texels) { return std::clamp(32 - int(std::ceil(std::log2(std::max(texels, 1.0)))), 1, 24); }

} // namespace gnomon::shadow::parts
