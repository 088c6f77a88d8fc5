// SPDX-License-Identifier: Apache-2.0
// What keys, drags, sliders and overlays of the viewer do, by events of a real X server.
#include "base/image_file.h"
#include "view_session.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class ViewDrive : public WithWindows {
protected:
    void TearDown() override
    {
        if (end) expect_silent(*end);
    }

    /// The picture that P writes now.
    base::Picture shot(const Viewer& viewer)
    {
        viewer.key("p");
        const std::string message = viewer.state()["message"];
        EXPECT_EQ(message.rfind("wrote ", 0), 0u) << message;
        return base::read_png(scratch / message.substr(6), base::Encoding::linear);
    }

    std::optional<Finished> end; ///< how the viewer ended
};

/// Pixels that differ, of rows [from, to).
size_t different(const base::Picture& a, const base::Picture& b, int from, int to)
{
    EXPECT_EQ(a.size, b.size);
    size_t count = 0;
    for (size_t i = size_t(from) * size_t(a.size.width); i < size_t(to) * size_t(a.size.width); ++i)
        count += !std::equal(&a.values[i * 3], &a.values[i * 3] + 3, &b.values[i * 3]);
    return count;
}
size_t different(const base::Picture& a, const base::Picture& b) { return different(a, b, 0, a.size.height); }

std::vector<double> numbers(const std::string& text)
{
    std::vector<double> out;
    std::istringstream stream(text);
    for (double v; stream >> v || !stream.eof();)
        if (stream)
            out.push_back(v);
        else
            stream.clear(), stream.ignore();
    return out;
}

TEST_F(ViewDrive, KeysFlyAndTheWheelComesNearer)
{
    Viewer viewer(scratch, {"balls", "--size", "320x180"});
    const Json before = viewer.state();
    viewer.tool("mousemove 600 350"); // keys are the window's that the mouse is in
    viewer.hold("w", "a camera that flies", [&](const Json& s) { return s["camera"] != before["camera"]; });
    const Json after = viewer.state();
    const std::vector<double> a = numbers(before["camera"]), b = numbers(after["camera"]);
    ASSERT_EQ(a.size(), b.size());
    ASSERT_GE(a.size(), 6u);
    double along = 0, across = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double eye = b[k] - a[k], target = b[k + 3] - a[k + 3];
        EXPECT_NEAR(eye, target, 1e-3) << "eye and target move together";
        along += eye * (a[k + 3] - a[k]), across += eye * eye;
    }
    EXPECT_GT(along, 0) << "forward";
    EXPECT_GT(across, 0);
    viewer.tool("click 4"); // the wheel
    viewer.wait("a nearer eye", [&](const Json& s) { return s["camera"] != after["camera"] && s["idle"].get<bool>(); });
    const std::vector<double> c = numbers(viewer.state()["camera"]);
    for (size_t k = 3; k < 6; ++k) EXPECT_NEAR(c[k], b[k], 1e-3) << "the target stays";
    viewer.key("Home");
    EXPECT_EQ(viewer.state()["camera"], before["camera"]);
    end = viewer.quit();
}

TEST_F(ViewDrive, TheSplitIsDraggedAndShowsBothSides)
{
    Viewer viewer(scratch, {"balls", "--size", "320x180", "--against", "shadow_map:pcf=9"});
    const Json before = viewer.state();
    EXPECT_EQ(before["split"], 0.5);
    viewer.key("v");
    const Json p = viewer.state()["picture"];
    const int width = p[2].get<int>() - p[0].get<int>();
    const base::Picture half = shot(viewer);
    viewer.drag(width / 2, 100, width / 4, 0);
    const Json after = viewer.state();
    EXPECT_NEAR(after["split"].get<double>(), 0.75, 0.02);
    EXPECT_EQ(before["camera"], after["camera"]);
    const base::Picture more = shot(viewer);
    size_t outside = 0, inside = 0;
    for (int y = 0; y < half.size.height; ++y)
        for (int x = 0; x < half.size.width; ++x) {
            const size_t i = 3 * (size_t(y) * size_t(half.size.width) + size_t(x));
            const bool other = !std::equal(&half.values[i], &half.values[i] + 3, &more.values[i]);
            (x >= half.size.width / 2 - 1 && x <= int(0.78 * half.size.width) ? inside : outside) += other;
        }
    EXPECT_GT(inside, 0u) << "what was the right side is the left one";
    EXPECT_EQ(outside, 0u);
    end = viewer.quit();
}

TEST_F(ViewDrive, SlidersAndDragsSetParametersAndTheLightsSize)
{
    Viewer viewer(
        scratch, {"plane", "--size", "240x135", "--technique", "blurred_depth", "--light", "sun,elevation=50,azimuth=30,angle=0"});
    const Json before = viewer.state();
    EXPECT_NE(before["lights"][0].get<std::string>().find("angle=0"), std::string::npos);
    viewer.slide("light size", 0.3);
    const Json slid = viewer.state();
    EXPECT_GT(numbers(slid["lights"][0]).back(), 1.0) << "degrees";
    EXPECT_EQ(before["camera"], slid["camera"]);
    viewer.tool("keydown l");
    viewer.drag(60, 60, 60, 0, 3);
    viewer.tool("keyup l");
    EXPECT_GT(numbers(viewer.state()["lights"][0]).back(), numbers(slid["lights"][0]).back());
    EXPECT_EQ(before["camera"], viewer.state()["camera"]);
    // what other sections leave no room for
    for (const char* section : {"Technique", "Picture", "Light", "Times"}) viewer.click(std::string("section ") + section);
    viewer.slide("parameter softness", 0.5);
    EXPECT_NE(viewer.state()["technique"].get<std::string>().find(":softness="), std::string::npos) << viewer.state()["technique"];
    viewer.click("reset");
    EXPECT_EQ(viewer.state()["technique"], "blurred_depth");
    end = viewer.quit();
}

TEST_F(ViewDrive, VolumesAreDrawnOverThePictureAndGoAgain)
{
    Viewer viewer(scratch, {"balls", "--size", "320x180", "--technique", "shadow_volumes"});
    viewer.key("v");
    const base::Picture plain = shot(viewer);
    viewer.key("b");
    const base::Picture lines = shot(viewer);
    EXPECT_GT(different(plain, lines), 200u);
    EXPECT_LT(different(plain, lines), plain.size.area() * 3 / 4);
    size_t yellow = 0;
    for (size_t i = 0; i < lines.size.area(); ++i) {
        const float* p = &lines.values[i * 3];
        yellow += p[0] > 0.99f && p[1] > 0.8f && p[1] < 0.9f && p[2] < 0.2f;
    }
    EXPECT_GT(yellow, 50u) << "silhouettes that nothing hides";
    viewer.key("b");
    EXPECT_EQ(different(plain, shot(viewer)), 0u);
    end = viewer.quit();
}

TEST_F(ViewDrive, WhatATechniqueOffersIsInspected)
{
    Viewer viewer(scratch, {"balls", "--size", "320x180", "--technique", "pcss", "--light", "sun,elevation=40,azimuth=30,angle=4"});
    viewer.key("v");
    const base::Picture plain = shot(viewer);
    viewer.key("n");
    EXPECT_EQ(viewer.state()["inspected"], "penumbra");
    const base::Picture width = shot(viewer);
    EXPECT_GT(different(plain, width), 300u);
    EXPECT_LT(different(plain, width), plain.size.area() / 2) << "where there is a penumbra, not everywhere";
    EXPECT_EQ(different(plain, width, 0, plain.size.height / 8), 0u) << "the sky has none";
    viewer.key("n");
    EXPECT_EQ(viewer.state()["inspected"], "");
    EXPECT_EQ(different(plain, shot(viewer)), 0u);
    viewer.key("n");
    viewer.key("Next"); // per_triangle_volumes
    viewer.wait("a sentence", [](const Json& s) { return s["error"].get<std::string>().find("offers no image") != std::string::npos; });
    end = viewer.quit();
}

TEST_F(ViewDrive, PagesOfAVirtualMapAreColoured)
{
    Viewer viewer(scratch, {"balls", "--size", "240x135", "--technique", "virtual_shadow_map"});
    viewer.key("v");
    const base::Picture plain = shot(viewer);
    viewer.key("n");
    EXPECT_EQ(viewer.state()["inspected"], "page");
    const base::Picture pages = shot(viewer);
    viewer.key("n");
    EXPECT_EQ(viewer.state()["inspected"], "level");
    const base::Picture levels = shot(viewer);
    EXPECT_GT(different(plain, pages), plain.size.area() / 8);
    EXPECT_GT(different(pages, levels), plain.size.area() / 8);
    end = viewer.quit();
}

TEST_F(ViewDrive, TinyAndHugeWindowsSurviveAndTheManagerClosesThem)
{
    Viewer viewer(scratch, {"plane", "--size", "160x90"});
    for (const auto& [width, height] : {std::pair{1, 1}, {37, 900}, {3000, 5}, {3200, 2000}, {900, 760}}) {
        viewer.window("windowsize % " + std::to_string(width) + " " + std::to_string(height));
        const Json size = {width, height};
        viewer.wait("the new size", [&](const Json& s) { return s["window"] == size && s["idle"].get<bool>(); });
    }
    viewer.key("Tab"); // the picture alone
    viewer.window("windowsize % 2 2");
    viewer.wait("two pixels", [](const Json& s) { return s["window"] == Json({2, 2}) && s["idle"].get<bool>(); });
    end = viewer.close();
}

/// A square that goes up by 2 m within 2 s.
void write_moving_scene(const fs::path& folder)
{
    std::ofstream bytes(folder / "moving.bin", std::ios::binary);
    const float positions[] = {-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1}, times[] = {0, 2}, places[] = {0, 0, 0, 0, 2, 0};
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    bytes.write(reinterpret_cast<const char*>(positions), sizeof positions);
    bytes.write(reinterpret_cast<const char*>(indices), sizeof indices);
    bytes.write(reinterpret_cast<const char*>(times), sizeof times);
    bytes.write(reinterpret_cast<const char*>(places), sizeof places);
    std::ofstream(folder / "moving.gltf") << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "scale": [4, 1, 4], "translation": [0, -1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": 2, "output": 3}]}],
        "buffers": [{"uri": "moving.bin", "byteLength": 104}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24},
            {"buffer": 0, "byteOffset": 72, "byteLength": 8}, {"buffer": 0, "byteOffset": 80, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0, 1]},
            {"bufferView": 1, "componentType": 5125, "count": 6, "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2]},
            {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}]})";
}

TEST_F(ViewDrive, AnimationsPlayStopAndAreInTheCommandLine)
{
    write_moving_scene(scratch.folder());
    Viewer viewer(scratch, {"moving.gltf", "--size", "160x90"});
    const Json before = viewer.state();
    EXPECT_EQ(before["duration"], 2.0);
    EXPECT_EQ(before["time"], 0.0);
    viewer.tool("mousemove 700 350 key space");
    viewer.wait("time that passes", [](const Json& s) { return s["time"].get<double>() > 0.2; });
    viewer.tool("key space");
    viewer.settled();
    const Json stopped = viewer.state();
    EXPECT_GT(stopped["time"].get<double>(), 0.2);
    EXPECT_LE(stopped["time"].get<double>(), 2.0);
    EXPECT_EQ(stopped["camera"], before["camera"]);
    EXPECT_EQ(stopped["lights"], before["lights"]);
    EXPECT_NE(stopped["command"].get<std::string>().find(" --time "), std::string::npos);
    // a file that goes stops the animation, and the picture stays
    fs::remove(scratch / "moving.gltf");
    viewer.key("space");
    viewer.wait("a sentence", [](const Json& s) { return s["message"].get<std::string>().find("moving.gltf") != std::string::npos; });
    viewer.key("Escape");
    viewer.settled();
    EXPECT_EQ(viewer.state()["time"], stopped["time"]);
    shot(viewer);
    end = viewer.quit();
}

TEST_F(ViewDrive, ItsPaceIsMeasured)
{
    const Display display;
    const RunOptions options{.environment = {{"DISPLAY", display.name()}, {"WAYLAND_DISPLAY", ""}, {"XDG_RUNTIME_DIR", scratch.folder()}}};
    const Finished f = run_gnomon({"view", "plane", "--size", "160x90", "--measure", "0.5", "--json"}, scratch.folder(), options);
    EXPECT_EQ(f.code, 0) << f.err;
    const Json json = Json::parse(f.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << f.out;
    ASSERT_EQ(json["measurements"].size(), 2u);
    for (const Json& m : json["measurements"]) {
        EXPECT_GT(m["frames"].get<int>(), 0);
        EXPECT_GT(m["frames_per_second"].get<double>(), 0.0);
        EXPECT_GT(m["passes_ms"]["gbuffer"].get<double>(), 0.0);
    }
    EXPECT_EQ(json["measurements"][0]["coarse_frames"], 0) << "at full size";
}

} // namespace
} // namespace gnomon::tests
