// SPDX-License-Identifier: Apache-2.0
// Words of a command line: lights, cameras, sizes, motions, goals, budgets, techniques with parameters, key=value texts.
#include "fuzz/target.h"
#include "lab/goal.h"
#include "lab/motion.h"
#include "lab/render.h"
#include "scene/option_text.h"

#include <nlohmann/json.hpp>

using namespace gnomon;

namespace {

struct Stand {
    Bounds bounds;
    std::vector<scene::Light> lights;
    std::vector<scene::Camera> cameras;
};

const Stand& stand()
{
    static const Stand one = [] {
        Stand out;
        out.bounds.add(vec3(-1));
        out.bounds.add(vec3(3, 2, 1));
        out.cameras.push_back(scene::fit_camera(out.bounds));
        out.cameras.back().name = "door";
        for (const char* kind : {"sun", "spot", "point", "rect", "disk"}) {
            out.lights.push_back(scene::parse_light(kind, {}, out.bounds));
            out.lights.back().name = std::string("own ") + kind;
        }
        return out;
    }();
    return one;
}

void read_light(const std::string& text)
{
    const scene::Light light = scene::parse_light(text, stand().lights, stand().bounds);
    for (const vec2 u : {vec2(0), vec2(0.5f), vec2(0.999f, 0.3f)}) {
        const vec4 p = scene::light_point(light, vec3(0.1f, 0.2f, 0.3f), u);
        fuzz::demand(std::isfinite(p.x + p.y + p.z), "a light is somewhere");
    }
    scene::reaches(light, vec3(0));
}

void read_camera(const std::string& text)
{
    const scene::Camera camera = scene::parse_camera(text, stand().cameras, stand().bounds);
    fuzz::accepts([&] {
        const scene::View view = scene::make_view(camera, {64, 48}, stand().bounds);
        scene::view_ray(view, vec2(3.5f, 40.5f));
    });
}

void read_choice(const std::string& text)
{
    const lab::Choice choice = lab::parse_choice(text);
    const std::string written = lab::choice_text(choice);
    fuzz::demand(lab::choice_text(lab::parse_choice(written)) == written, "a technique with parameters comes back as it was written");
    shadow::ParamValues again(choice.info->params());
    again.set_json(choice.params.json());
    fuzz::demand(std::ranges::equal(again.bytes(), choice.params.bytes()), "parameters come back from JSON");
}

void read_motion(const std::string& text)
{
    const lab::Motion motion = lab::parse_motion(text);
    lab::parse_motion(lab::motion_text(motion));
    lab::moved(stand().cameras.front(), motion, 2);
    for (const scene::Light& light : stand().lights) lab::moved(light, motion, 2);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::string text(fuzz::text_of(data, size));
    fuzz::accepts([&] { read_light(text); });
    fuzz::accepts([&] { read_camera(text); });
    fuzz::accepts([&] { read_motion(text); });
    // "@file" would read whatever lies there, which is what the target `files` does
    if (!text.starts_with('@')) fuzz::accepts([&] { read_choice(text); });
    fuzz::accepts([&] { lab::parse_size(text); });
    fuzz::accepts([&] { lab::parse_constraint(text); });
    fuzz::accepts([&] { lab::parse_budget(text); });
    fuzz::accepts([&] { lab::parse_terms(text); });
    const scene::OptionPlace place{"light", text, "key"};
    fuzz::accepts([&] { scene::split_options(text); });
    fuzz::accepts([&] { scene::option_vec3(place, text); });
    fuzz::accepts([&] { scene::option_color(place, text); });
    return 0;
}
