// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/light_image.h"

#include "shadow/parts/light_samples.h"

namespace gnomon::shadow::parts {

namespace {

void add_sums(std::vector<vec4>& out, const scene::LightImage& image)
{
    const double texel = 1.0 / double(image.texels.size());
    std::vector<glm::dvec3> row(size_t(image.width) + 1, glm::dvec3(0.0));
    for (int y = 0; y <= image.height; ++y) {
        for (const glm::dvec3& sum : row) out.emplace_back(vec3(sum), 0.0f);
        if (y == image.height) break;
        glm::dvec3 left(0.0);
        for (int x = 0; x < image.width; ++x) {
            left += texel * glm::dvec3(image.texels[size_t(image.height - 1 - y) * size_t(image.width) + size_t(x)]);
            row[size_t(x) + 1] += left;
        }
    }
}

std::vector<vec4> sample_colors(const scene::LightImage& image, const std::vector<glm::ivec2>& cells)
{
    std::vector<vec4> out;
    glm::dvec4 sum(0.0);
    for (const glm::ivec2 cell : cells) {
        out.emplace_back(image.at((vec2(cell) + 0.5f) / float(light_sample_grid)), 1.0f);
        sum += glm::dvec4(out.back());
    }
    for (vec4& color : out)
        for (int c = 0; c < 4; ++c) color[c] = float(sum[c] > 0.0 ? double(color[c]) / sum[c] : 1.0 / double(cells.size()));
    return out;
}

} // namespace

std::vector<vec4> light_image_table(const scene::LightImage& image, const std::vector<glm::ivec2>& sample_cells)
{
    const int first_sample = 1 + (image.width + 1) * (image.height + 1);
    std::vector<vec4> out = {vec4(image.width, image.height, first_sample, 0)};
    add_sums(out, image);
    const std::vector<vec4> colors = sample_colors(image, sample_cells);
    out.insert(out.end(), colors.begin(), colors.end());
    return out;
}

} // namespace gnomon::shadow::parts
