// SPDX-License-Identifier: Apache-2.0
#include "lab/slice.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

/// The segment in which a triangle meets the plane on which `height` is 0; the ends in the plane's own pixels.
bool cut(const std::array<vec2, 3>& pixel, const std::array<float, 3>& height, std::array<vec2, 2>& out)
{
    int ends = 0;
    for (size_t i = 0; i < 3 && ends < 2; ++i) {
        const size_t j = (i + 1) % 3;
        // a corner on the plane belongs to one side, so that neighbours neither miss nor repeat it
        if ((height[i] < 0) == (height[j] < 0)) continue;
        out[size_t(ends++)] = glm::mix(pixel[i], pixel[j], height[i] / (height[i] - height[j]));
    }
    return ends == 2;
}

void draw(base::Picture& picture, vec2 from, vec2 to)
{
    const vec3 color(0.95f, 0.35f, 0.05f);
    const float length = glm::length(to - from);
    const int steps = int(std::min(length, 4.0f * float(picture.size.width + picture.size.height)) * 2.0f) + 1;
    for (int i = 0; i <= steps; ++i) {
        const vec2 p = glm::mix(from, to, float(i) / float(steps));
        if (!(p.x >= 0 && p.y >= 0 && p.x < float(picture.size.width) && p.y < float(picture.size.height))) continue;
        for (int c = 0; c < 3; ++c) picture.at(int(p.x), int(p.y), c) = color[c];
    }
}

} // namespace

std::vector<std::array<vec2, 2>> slice_outline(const scene::Scene& scene, const Slice& slice)
{
    std::vector<std::array<vec2, 2>> out;
    const vec2 size(float(slice.view.size.width), float(slice.view.size.height));
    for (const scene::Instance& instance : scene.instances) {
        const scene::Mesh& mesh = scene.meshes[size_t(instance.mesh)];
        if (scene.materials[size_t(mesh.material)].alpha == scene::AlphaMode::blend) continue;
        const mat4 clip_from_object = slice.view.clip_from_world * instance.world_from_object;
        std::vector<vec3> clip(mesh.positions.size());
        for (size_t i = 0; i < clip.size(); ++i) clip[i] = vec3(clip_from_object * vec4(mesh.positions[i], 1.0f)); // orthographic: w = 1
        for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
            std::array<vec2, 3> pixel;
            std::array<float, 3> height;
            for (size_t k = 0; k < 3; ++k) {
                const vec3 p = clip[mesh.indices[t + k]];
                pixel[k] = (vec2(p) * 0.5f + 0.5f) * size, height[k] = p.z - slice.depth;
            }
            std::array<vec2, 2> segment;
            if (cut(pixel, height, segment)) out.push_back(segment);
        }
    }
    return out;
}

base::Picture slice_display(const base::Picture& image, const std::vector<std::array<vec2, 2>>& outline)
{
    base::Picture out(image.size, 3);
    for (size_t i = 0; i < image.size.area(); ++i)
        for (size_t c = 0; c < 3; ++c) out.values[i * 3 + c] = image.values[i * size_t(image.channels) + (image.channels == 3 ? c : 0)];
    for (const auto& [from, to] : outline) draw(out, from, to);
    return out;
}

} // namespace gnomon::lab
