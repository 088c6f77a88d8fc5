// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exact_suite.h"

#include <algorithm>
#include <cmath>
#include <vector>

extern const gnomon::shadow::TechniqueInfo technique_per_triangle_volumes;

namespace gnomon {

/// Values of per_triangle_volumes' parameter `mode`.
namespace per_triangle_mode {
inline constexpr double binary = 0, alpha = 1, rgb = 2, textured = 3, stochastic = 4;
}

inline scene::Material blended(vec4 color)
{
    scene::Material m;
    m.alpha = scene::AlphaMode::blend;
    m.base_color = color;
    m.double_sided = true;
    return m;
}

/// A floor under horizontal panes, one a colour, the first of them lowest.
inline scene::Scene panes(const std::vector<scene::Material>& glass)
{
    scene::Scene s = floor_scene(4);
    for (size_t k = 0; k < glass.size(); ++k) {
        gpu::add_quad(s, {0.01f * float(k % 7), 0.5f + 2.0f * float(k) / float(glass.size()), 0.02f * float(k % 5)}, 3);
        s.meshes.back().material = int(s.materials.size());
        s.materials.push_back(glass[k]);
    }
    return s;
}

/// Cards with a texture of smooth colours and alphas; or only of alphas, which make shades of grey.
inline scene::Scene cards(scene::AlphaMode mode, double texels, bool colored = true)
{
    scene::Scene s = floor_scene(4);
    scene::Texture t;
    t.width = t.height = int(texels);
    for (double y = 0; y < 6.28; y += 6.28319 / texels)
        for (double x = 0; x < 6.28; x += 6.28319 / texels)
            for (const double v : {std::sin(2 * x), std::cos(3 * y + x), std::sin(2 * y), std::cos(3 * x) * std::sin(2 * y)})
                t.rgba.push_back(uint8_t(std::lround(127.5 + 127.0 * v)));
    s.textures.push_back(t);
    scene::Material m = blended(vec4(0.9f, 1, 0.8f, 0.9f));
    if (!colored) {
        m.base_color = vec4(1);
        for (size_t i = 0; i < t.rgba.size(); ++i)
            if (i % 4 != 3) s.textures[0].rgba[i] = 255;
    }
    m.alpha = mode;
    m.base_color_texture = {0, {1.2f, 0.3f, 0.1f}, {-0.2f, 0.9f, 0.4f}};
    if (mode == scene::AlphaMode::mask) m.transmission = 0.4f;
    s.materials.push_back(m);
    Uniform uniform(5);
    scene::Mesh mesh;
    mesh.material = 1;
    for (uint32_t k = 0; k < 12; ++k) {
        const vec3 centre = vec3(0, 1.6f, 0) + uniform.in_cube() * vec3(2, 1, 2), u = uniform.in_cube(), v = uniform.in_cube();
        for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
            mesh.positions.push_back(centre + corner.x * u + corner.y * v);
            mesh.uvs.push_back(corner * 0.7f);
            mesh.colors.push_back(colored ? 0xff000000u | uint32_t(uniform(0, 1) * 127) << 8 | 0x8040c0u : 0xffffffffu);
        }
        for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(4 * k + i);
    }
    add_mesh(s, mesh);
    return s;
}

class PerTriangleTest : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& v)
    {
        return TechniqueTest::draw(technique_per_triangle_volumes, s, camera, size, light, v);
    }
};

} // namespace gnomon
