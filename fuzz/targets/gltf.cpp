// SPDX-License-Identifier: Apache-2.0
// glTF and GLB: containers, accessors, compression, images, skins, morphs, animations, lights, cameras.
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "scene/animation.h"
#include "scene/load.h"

using namespace gnomon;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::filesystem::path file = fuzz::write("scene.glb", fuzz::text_of(data, size));
    fuzz::accepts([&] {
        const scene::Scene scene = scene::load(file.string(), {.time = 0.4});
        fuzz::demand(scene::unsound(scene).empty(), scene::unsound(scene));
        fuzz::demand(scene.first_primitives().size() == scene.instances.size(), "instances have primitive numbers");
        for (const scene::Light& light : scene.lights) scene::light_point(light, vec3(0), vec2(0.3f));
        for (const scene::Camera& camera : scene.cameras) fuzz::accepts([&] { scene::make_view(camera, {64, 48}, scene.bounds()); });
        scene::make_view(scene::fit_camera(scene.bounds()), {64, 48}, scene.bounds());
    });
    fuzz::accepts([&] { scene::animation_seconds(file.string()); });
    return 0;
}
