// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"

namespace gnomon::scene::generators {

Stage::Stage(std::string name, double detail)
    : fineness_(float(std::sqrt(detail)))
{
    scene_.name = std::move(name);
}

int Stage::texture(Texture t)
{
    scene_.textures.push_back(std::move(t));
    return int(scene_.textures.size()) - 1;
}

int Stage::material(Material m)
{
    scene_.materials.push_back(std::move(m));
    return int(scene_.materials.size()) - 1;
}

int Stage::material(std::string name, vec3 base, float roughness, int texture)
{
    Material m;
    m.name = std::move(name);
    m.base_color = vec4(base, 1.0f);
    m.roughness = roughness;
    m.base_color_texture.texture = texture;
    return material(std::move(m));
}

int Stage::mesh(std::string name, MeshBuilder&& b)
{
    scene_.meshes.push_back(std::move(b).finish(std::move(name)));
    return int(scene_.meshes.size()) - 1;
}

void Stage::camera(std::string name, vec3 eye, vec3 target, float fov_degrees)
{
    Camera c;
    c.name = std::move(name);
    c.eye = eye, c.target = target;
    c.fov_y = glm::radians(fov_degrees);
    scene_.cameras.push_back(std::move(c));
}

void Stage::sun(std::string name, float elevation, float azimuth, float diameter, vec3 color)
{
    const float e = glm::radians(elevation), a = glm::radians(azimuth);
    const vec3 towards(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
    scene_.lights.push_back({std::move(name), color, {}, DirectionalLight{-glm::normalize(towards), glm::radians(0.5f * diameter)}});
}

void Stage::spot(std::string name, vec3 position, vec3 target, float cone, float radius, vec3 color)
{
    const float outer = glm::radians(0.5f * cone);
    scene_.lights.push_back(
        {std::move(name), color, {}, SpotLight{position, glm::normalize(target - position), 0.8f * outer, outer, radius}});
}

void Stage::point(std::string name, vec3 position, float radius, vec3 color)
{
    scene_.lights.push_back({std::move(name), color, {}, PointLight{position, radius}});
}

void Stage::rect(std::string name, vec3 centre, vec3 half_u, vec3 half_v, vec3 color)
{
    scene_.lights.push_back({std::move(name), color, {}, RectLight{centre, half_u, half_v}});
}

void Stage::disk(std::string name, vec3 centre, vec3 target, float radius, vec3 color)
{
    scene_.lights.push_back({std::move(name), color, {}, DiskLight{centre, glm::normalize(target - centre), radius}});
}

} // namespace gnomon::scene::generators
