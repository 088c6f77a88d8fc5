// SPDX-License-Identifier: Apache-2.0
// Every technique that draws penumbrae, with lights that no scene should have: without a size, larger than the scene, in it, on the floor,
// turned away, and before maps of a few texels.
#include "lab/render.h"
#include "technique_suite.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon {
namespace {

std::vector<const shadow::TechniqueInfo*> soft_techniques()
{
    std::vector<const shadow::TechniqueInfo*> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        if (info->soft) out.push_back(info);
    return out;
}

class SoftLights : public TechniqueSuite<SoftLights> {
protected:
    static base::Picture draw(const char* scene, const std::string& light, int map_size)
    {
        const lab::Stage stage = lab::open_stage({.scene = scene, .lights = {light}, .size = {48, 36}});
        shadow::SceneGpu resources(*device_, stage.scene);
        lab::Choice choice{GetParam(), shadow::ParamValues(GetParam()->params())};
        for (const shadow::ParamInfo& p : GetParam()->params().fields) {
            if (p.name == "map_size") choice.params.set(p.name, map_size);
            if (p.name == "samples") choice.params.set(p.name, 16);
        }
        return lab::render(*device_, resources, stage, choice, {.lit = false}).images.front();
    }

    static void expect_fractions(const char* scene, const std::string& light, int map_size = 128)
    {
        const base::Picture first = draw(scene, light, map_size), second = draw(scene, light, map_size);
        EXPECT_EQ(std::ranges::count_if(first.values, [](float v) { return !(v >= 0.0f && v <= 1.0f); }), 0)
            << scene << " " << light << ", map " << map_size;
        EXPECT_EQ(first.values, second.values) << scene << " " << light;
    }
};

const char* const odd_lights[] = {"sun,elevation=50,angle=0", "spot,position=2/5/1,target=0/0/0,radius=0", "point,position=2/5/1,radius=0",
    "rect,position=0/4/0,target=0/0/0,width=0.0001,height=0.0001", "disk,position=0/4/0,target=0/0/0,radius=0.0001", // no size
    "sun,elevation=50,angle=170", "point,position=0/4/0,radius=60", "rect,position=0/4/0,target=0/0/0,width=200,height=0.01",
    "disk,position=0/4/0,target=0/0/0,radius=90", // larger than the scene
    "point,position=0/0/0,radius=0.5", "rect,position=0/0/0,target=0/-1/0,width=1,height=1", // on the floor, and through it
    "rect,position=0/0.3/0,target=1/0.3/0,width=1,height=1", "disk,position=0/0.5/0,target=0/3/0,radius=1", // across it, turned away
    "sun,elevation=0.05,angle=3", "sun,elevation=-20,angle=3"}; // grazing, and from below

TEST_P(SoftLights, OddOnesGiveFractions)
{
    for (const char* light : odd_lights) expect_fractions("contact", light);
}

TEST_P(SoftLights, MapsOfAFewTexelsGiveFractions)
{
    for (const char* light :
        {"sun,elevation=50,angle=40", "point,position=0/4/0,radius=2", "rect,position=0/4/0,target=0/0/0,width=3,height=3"})
        expect_fractions("contact", light, 16);
}

TEST_P(SoftLights, AnEmptyFloorIsLit)
{
    for (const char* light : {"sun,elevation=50,angle=8", "rect,position=0/4/0,target=0/0/0,width=1,height=1"}) {
        const base::Picture lit = draw("plane", light, 128);
        EXPECT_GT(*std::ranges::min_element(lit.values), 0.97f) << light;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Techniques, SoftLights, testing::ValuesIn(soft_techniques()), [](const auto& p) { return std::string(p.param->id); });

} // namespace
} // namespace gnomon
