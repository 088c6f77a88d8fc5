// SPDX-License-Identifier: Apache-2.0
// Every prefiltered map of the registry where parameters meet: windows wider than the map, exponents at the end of what a format holds,
// maps that hold nothing. conformance_test.cpp takes the ends of one parameter at a time.
#include "lab/render.h"
#include "technique_suite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Parameters and their values; of a choice, its index.
using Settings = std::vector<std::pair<std::string, double>>;

std::string text(const Settings& settings)
{
    std::string out;
    for (const auto& [name, value] : settings) out += name + "=" + std::to_string(value) + " ";
    return out;
}

Settings operator+(Settings a, const Settings& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::vector<const shadow::TechniqueInfo*> filtered_maps()
{
    std::vector<const shadow::TechniqueInfo*> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        if (std::string_view(info->family) == "filtered hard shadows") out.push_back(info);
    return out;
}

/// Lights whose maps are one orthographic layer, one perspective layer and a cube of six faces.
const char* const lights[] = {"sun,elevation=55,azimuth=30,angle=0", "spot,position=2/5/1,target=0/0/0,cone=70,radius=0,intensity=40",
    "point,position=2/5/1,radius=0,intensity=40"};

class FilteredMaps : public TechniqueSuite<FilteredMaps> {
protected:
    /// A scene on the device, drawn by this test's technique.
    struct Drawer {
        lab::Stage stage;
        shadow::SceneGpu scene;
        Drawer(const lab::StageOptions& options)
            : stage(lab::open_stage(options))
            , scene(*device_, stage.scene)
        {
        }
        base::Picture operator()(const Settings& settings)
        {
            lab::Choice choice{GetParam(), shadow::ParamValues(GetParam()->params())};
            for (const auto& [name, value] : settings) choice.params.set(name, value);
            return lab::render(*device_, scene, stage, choice, {.lit = false}).images.front();
        }
    };

    /// Every way to choose among `names`, or among all choices and flags where there are none.
    static std::vector<Settings> choices(const std::vector<std::string>& names = {})
    {
        std::vector<Settings> out = {{}};
        for (const shadow::ParamInfo& p : GetParam()->params().fields) {
            const bool listed = p.type == shadow::ParamType::choice || p.type == shadow::ParamType::flag;
            // cascades of either kind are layers to a filter
            if (!listed || p.name == "stable_cascades" || (!names.empty() && std::ranges::find(names, p.name) == names.end())) continue;
            std::vector<Settings> longer;
            for (const Settings& s : out)
                for (double v = p.range.min; v <= p.range.max; ++v) longer.push_back(s + Settings{{p.name, v}});
            out = longer;
        }
        return out;
    }

    /// What shields a technique from rounding and from bleeding is off, and its exponents are at one end.
    static Settings strained(bool largest_exponents)
    {
        Settings out;
        for (const shadow::ParamInfo& p : GetParam()->params().fields) {
            if (p.name.ends_with("exponent")) out.emplace_back(p.name, largest_exponents ? p.range.max : p.range.min);
            if (p.name == "min_deviation" || p.name == "moment_bias" || p.name == "bleed_reduction") out.emplace_back(p.name, 0.0);
        }
        return out;
    }

    /// Draws twice: the same bits, all of them visibilities.
    static base::Picture expect_sane(Drawer& draw, const Settings& settings)
    {
        const base::Picture first = draw(settings), second = draw(settings);
        const auto broken = std::ranges::count_if(first.values, [](float v) { return !(v >= 0.0f && v <= 1.0f); });
        EXPECT_EQ(broken, 0) << text(settings);
        EXPECT_EQ(first.values, second.values) << text(settings);
        return first;
    }
};

TEST_P(FilteredMaps, WindowsWiderThanTheMap)
{
    for (const char* light : lights) {
        Drawer draw({.scene = "contact", .lights = {light}, .size = {48, 36}});
        for (const Settings& prefilter : choices({"prefilter"}))
            for (const auto& [map_size, kernel] : {std::pair{16, 127}, std::pair{64, 127}, std::pair{64, 126}}) {
                SCOPED_TRACE(light);
                expect_sane(draw, prefilter + Settings{{"map_size", map_size}, {"kernel", kernel}});
            }
    }
}

TEST_P(FilteredMaps, AllChoicesWithNothingToShieldThem)
{
    for (const char* light : {lights[0], lights[2]}) {
        Drawer draw({.scene = "contact", .lights = {light}, .size = {48, 36}});
        for (const Settings& choice : choices())
            for (const bool largest : {false, true}) {
                SCOPED_TRACE(light);
                expect_sane(draw, choice + strained(largest) + Settings{{"map_size", 64}, {"kernel", largest ? 8 : 31}});
            }
    }
}

TEST_P(FilteredMaps, OneTexelWindows)
{
    for (const char* light : lights) {
        Drawer draw({.scene = "contact", .lights = {light}, .size = {48, 36}});
        for (const Settings& prefilter : choices({"prefilter"})) {
            SCOPED_TRACE(light);
            expect_sane(draw, prefilter + strained(true) + Settings{{"map_size", 64}, {"kernel", 1}});
        }
    }
}

/// Nothing stands before the light, and the picture is all floor; or nothing stands before the camera.
TEST_P(FilteredMaps, EmptyMaps)
{
    const std::string upward = "eye=0/1/0,target=0/9/0.1,up=0/0/1";
    for (const Settings& split : choices({"prefilter", "split", "fit"})) {
        Drawer dark({.scene = "plane", .lights = {"spot,position=0/5/0,target=0/9/0,cone=40,radius=0,intensity=40"}, .size = {48, 36}});
        const base::Picture unlit = expect_sane(dark, split + Settings{{"map_size", 64}});
        EXPECT_LT(*std::ranges::min_element(unlit.values), 0.01f) << text(split); // the floor
        for (const char* light : lights) {
            Drawer sky({.scene = "plane", .camera = upward, .lights = {light}, .size = {48, 36}});
            for (const float v : expect_sane(sky, split + Settings{{"map_size", 64}}).values)
                ASSERT_EQ(v, 1.0f) << light << " " << text(split);
        }
    }
}

/// The same window of the world in twice the texels, next to a window of half the width.
TEST_P(FilteredMaps, TexelsAreNoPartOfThePicture)
{
    for (const char* light : lights) {
        Drawer draw({.scene = "contact", .lights = {light}, .size = {160, 120}});
        for (const Settings& prefilter : choices({"prefilter"})) {
            const base::Picture coarse = draw(prefilter + Settings{{"map_size", 128}, {"kernel", 9}});
            const base::Picture fine = draw(prefilter + Settings{{"map_size", 256}, {"kernel", 18}});
            const base::Picture narrow = draw(prefilter + Settings{{"map_size", 256}, {"kernel", 9}});
            const auto difference = [&](const base::Picture& a, const base::Picture& b) {
                double sum = 0;
                for (size_t i = 0; i < a.values.size(); ++i) sum += std::abs(double(a.values[i]) - double(b.values[i]));
                return sum / double(a.values.size());
            };
            EXPECT_LT(difference(coarse, fine), 0.4 * difference(coarse, narrow)) << light << " " << text(prefilter);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Techniques, FilteredMaps, testing::ValuesIn(filtered_maps()), [](const auto& p) { return std::string(p.param->id); });

} // namespace
} // namespace gnomon
