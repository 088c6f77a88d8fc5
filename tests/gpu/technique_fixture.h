// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device_fixture.h"

#include "shadow/gbuffer.h"
#include "shadow/technique.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::gpu {

/// A horizontal square of half width `half` at `centre`.
inline void add_quad(scene::Scene& s, vec3 centre, float half)
{
    scene::Mesh quad;
    quad.positions = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}};
    quad.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(quad);
    s.instances.push_back({int(s.meshes.size()), glm::translate(mat4(1), centre)});
    s.meshes.push_back(quad);
}

inline scene::Scene floor_scene(float half)
{
    scene::Scene s;
    s.materials.emplace_back();
    s.materials[0].double_sided = true;
    add_quad(s, vec3(0), half);
    return s;
}

/// A floor whose half x < 0 is shadowed by a sheet one metre above it when the sun is overhead.
inline scene::Scene half_shadowed()
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-2, 1, 0}, 2);
    return s;
}

/// Straight down on the floor around `target` from `height` above it, `half` metres each way.
inline scene::Camera camera_above(vec3 target, float height, float half)
{
    return {.eye = target + vec3(0, height, 0), .target = target, .up = {0, 0, -1}, .half_height = half};
}

/// Tests of a whole technique on scenes of a few quads, where visibility has a closed form.
class TechniqueTest : public DeviceTest {
protected:
    using Values = std::vector<std::pair<const char*, double>>;

    static std::vector<float> draw(const shadow::TechniqueInfo& info, const scene::Scene& s, const scene::Camera& camera, Size size,
        const char* light, const Values& values)
    {
        return draw(info, s, camera, size, scene::parse_light(light, {}, s.bounds()), values);
    }

    /// Four values a pixel where the technique writes colours.
    static std::vector<float> draw(const shadow::TechniqueInfo& info, const scene::Scene& s, const scene::Camera& camera, Size size,
        const scene::Light& light, const Values& values)
    {
        const Bounds bounds = s.bounds();
        const scene::View view = scene::make_view(camera, size, bounds);
        shadow::ParamValues params(info.params());
        for (const auto& [name, value] : values) params.set(name, value);
        shadow::SceneGpu scene(device(), s);
        Image out = image("visibility", shadow::output_format(info, params.bytes(), light), size);
        const std::unique_ptr<shadow::Technique> technique = info.create(device());
        PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        technique->record(passes, {s, view, light, scene, g, passes.import(out), 0}, params.bytes());
        device().submit(std::move(passes));
        return device().read_back(out).values;
    }

    /// What it counts.
    static std::map<std::string, uint64_t> count(const shadow::TechniqueInfo& info, const scene::Scene& s, const scene::Camera& camera,
        Size size, const char* text, const Values& given)
    {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const scene::View view = scene::make_view(camera, size, s.bounds());
        shadow::ParamValues params(info.params());
        for (const auto& [name, value] : given) params.set(name, value);
        shadow::SceneGpu scene(device(), s);
        Image out = image("visibility", shadow::output_format(info, params.bytes(), light), size);
        const std::unique_ptr<shadow::Technique> technique = info.create(device());
        PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        std::vector<shadow::Counter> counters;
        technique->record(passes, {s, view, light, scene, g, passes.import(out), 0, nullptr, &counters}, params.bytes());
        Buffer counted = storage<uint32_t>("counted", counters.size());
        for (size_t i = 0; i < counters.size(); ++i) passes.copy(counters[i].buffer, passes.import(counted), 4, counters[i].offset, 4 * i);
        device().submit(std::move(passes));
        const std::vector<uint32_t> numbers = values<uint32_t>(counted);
        std::map<std::string, uint64_t> counts;
        for (size_t i = 0; i < counters.size(); ++i) counts[counters[i].name] += numbers[i];
        return counts;
    }

    static double mean(const std::vector<float>& v)
    {
        double sum = 0;
        for (const float x : v) sum += double(x);
        return sum / double(v.size());
    }
};

} // namespace gnomon::gpu
