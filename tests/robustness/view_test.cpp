// SPDX-License-Identifier: Apache-2.0
#include "tests/source_root.h"
#include "view_session.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace gnomon::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

using View = WithWindows;

/// The words of a command line as a POSIX shell takes them, of what shell_word writes.
std::vector<std::string> words_of(const std::string& line)
{
    std::vector<std::string> words(1);
    bool quoted = false;
    for (size_t i = 0; i < line.size(); ++i)
        if (line[i] == '\'')
            quoted = !quoted;
        else if (line[i] == ' ' && !quoted)
            words.emplace_back();
        else
            words.back() += line[i] == '\\' && !quoted ? line[++i] : line[i];
    return words;
}

TEST_F(View, WithoutADisplayASentenceNamesTheNextStep)
{
    const RunOptions none{.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"XDG_RUNTIME_DIR", scratch.folder()}}};
    expect_sentence(run_gnomon({"view", "plane"}, scratch.folder(), none), 1, {"display", "xvfb-run", "gnomon render"});
}

TEST_F(View, MouseMovesTheCameraAndTheCopiedCommandRendersTheSamePicture)
{
    Viewer viewer(scratch, {"balls", "--size", "320x180", "--technique", "shadow_map", "--shadow_map.pcf", "5", "--exposure", "0.5"});
    const Json before = viewer.state();
    viewer.key("p");
    viewer.drag(100, 60, 80, 24);
    const Json after = viewer.state();
    EXPECT_NE(before["camera"], after["camera"]);
    EXPECT_EQ(before["lights"], after["lights"]);
    viewer.tool("keydown l");
    viewer.drag(100, 60, 40, 20);
    viewer.tool("keyup l");
    EXPECT_NE(after["lights"], viewer.state()["lights"]);
    EXPECT_EQ(after["camera"], viewer.state()["camera"]);
    viewer.key("p");
    viewer.key("c");
    const std::string command = viewer.state()["command"];
    const Finished f = viewer.quit();
    expect_silent(f);
    EXPECT_EQ(f.out, command + "\n");

    std::vector<std::string> words = words_of(command);
    ASSERT_EQ(words.at(0), "gnomon");
    words.erase(words.begin());
    words.insert(words.end(), {"-o", "again.png"});
    ASSERT_EQ(run_gnomon(words, scratch.folder()).code, 0) << command;
    const std::string shown = read_whole(scratch / "out/view.balls.shadow_map.2.png");
    ASSERT_FALSE(shown.empty());
    EXPECT_EQ(shown, read_whole(scratch / "again.png")) << command;
    EXPECT_NE(shown, read_whole(scratch / "out/view.balls.shadow_map.png"));
}

TEST_F(View, WidgetsAndKeysDoWhatTheySay)
{
    Viewer viewer(scratch, {"balls", "--size", "320x180", "--technique", "csm"});
    viewer.click("technique blurred_depth");
    EXPECT_EQ(viewer.state()["technique"], "blurred_depth");
    viewer.click("wireframe");
    viewer.key("p");
    viewer.click("wireframe");
    viewer.key("p");
    EXPECT_NE(read_whole(scratch / "out/view.balls.blurred_depth.png"), read_whole(scratch / "out/view.balls.blurred_depth.2.png"));
    viewer.key("F1");
    EXPECT_TRUE(viewer.state()["help"].get<bool>());
    viewer.key("Escape");
    EXPECT_FALSE(viewer.state()["help"].get<bool>());
    viewer.key("Next");
    EXPECT_EQ(viewer.state()["technique"], "csm");
    expect_silent(viewer.quit());
}

TEST_F(View, SurvivesResizingAndMinimising)
{
    Viewer viewer(scratch, {"plane", "--size", "160x90"});
    for (const auto& [width, height] : {std::pair{700, 500}, {1100, 640}, {321, 201}}) {
        viewer.window("windowsize % " + std::to_string(width) + " " + std::to_string(height));
        const Json size = {width, height};
        viewer.wait("the new size", [&](const Json& s) { return s["window"] == size && s["idle"].get<bool>(); });
    }
    viewer.window("windowsize % 900 700");
    viewer.settled();
    viewer.window("windowunmap %");
    viewer.window("windowmap %");
    viewer.settled();
    viewer.tool("mousemove 500 300");
    viewer.key("v");
    EXPECT_EQ(viewer.state()["show"], "visibility");
    expect_silent(viewer.quit());
}

TEST_F(View, TruthRefinesAndTheErrorMapShowsIt)
{
    Viewer viewer(scratch, {"balls", "--size", "240x135", "--against", "truth", "--light", "sun,elevation=50,azimuth=30,angle=4"});
    viewer.wait("some samples", [](const Json& s) { return s["truth_samples"].get<int>() >= 9; });
    viewer.drag(40, 40, 40, 8);
    viewer.wait("samples of the new view", [](const Json& s) { return s["truth_samples"].get<int>() >= 5; });
    viewer.key("x");
    EXPECT_EQ(viewer.state()["show"], "error");
    expect_silent(viewer.quit());
}

TEST_F(View, ErrorsAreShownAndNothingIsLost)
{
    fs::create_directories(scratch / "scenes");
    std::ofstream(scratch / "scenes/own.json") << R"({"model": "balls", "cameras": [], "lights": []})";
    ASSERT_EQ(run_gnomon({"render", "scenes/own.json", "--size", "16x16", "-o", "a.png"}, scratch.folder()).code, 0);
    Viewer viewer(scratch, {"scenes/own.json", "--size", "240x135", "--technique", "back_projection", "--light", "rect"});
    fs::remove(scratch / "scenes/own.json");
    viewer.click("technique alias_free");
    EXPECT_NE(viewer.state()["error"].get<std::string>().find("alias_free does not work with rect lights"), std::string::npos);
    viewer.click("technique back_projection");
    EXPECT_EQ(viewer.state()["error"], "");
    viewer.key("F9");
    EXPECT_NE(viewer.state()["message"].get<std::string>().find("own.json"), std::string::npos);
    viewer.key("Escape");
    viewer.click("technique blurred_depth");
    viewer.click("technique back_projection");
    viewer.key("p");
    EXPECT_TRUE(fs::exists(scratch / "out/view.own.back_projection.png"));
    expect_silent(viewer.quit());
}

/// The GLSL of the source tree and what it includes, with the files' times, which say what has changed.
void copy_shaders(const fs::path& to)
{
    for (const char* top : {"shaders", "src", "techniques", "apps"})
        for (const auto& entry : fs::recursive_directory_iterator(source_root() / top)) {
            const std::string extension = entry.path().extension();
            if (extension != ".glsl" && extension != ".h") continue;
            const fs::path target = to / fs::relative(entry.path(), source_root());
            fs::create_directories(target.parent_path());
            fs::copy_file(entry.path(), target);
            fs::last_write_time(target, entry.last_write_time());
        }
}

TEST_F(View, ShadersAreRecompiledAndBrokenOnesLeftAlone)
{
    const fs::path tree = scratch / "tree", shader = tree / "techniques/shadow_map/shadow_map_resolve.frag.glsl";
    copy_shaders(tree);
    Viewer viewer(scratch, {"balls", "--size", "240x135"}, {{"GNOMON_ROOT", tree}});
    const auto edit = [&](const std::string& text) {
        std::ofstream(shader) << text;
        // Where the program is of this very second.
        fs::last_write_time(shader, fs::file_time_type::clock::now());
        viewer.key("r");
    };
    viewer.key("r");
    EXPECT_NE(viewer.state()["message"].get<std::string>().find("no shader has changed"), std::string::npos) << viewer.state()["message"];
    viewer.key("p");
    const std::string original = read_whole(shader);
    edit(original.substr(0, original.rfind('}')) + "    visibility = 0.0;\n}\n");
    EXPECT_EQ(viewer.state()["message"], "recompiled techniques/shadow_map/shadow_map_resolve.frag");
    viewer.key("p");
    edit(original + "nonsense");
    EXPECT_NE(viewer.state()["message"].get<std::string>().find("shadow_map_resolve.frag.glsl:"), std::string::npos);
    viewer.key("p");
    edit(original);
    viewer.key("p");
    expect_silent(viewer.quit());
    const auto shot = [&](const std::string& number) { return read_whole(scratch / ("out/view.balls.shadow_map" + number + ".png")); };
    EXPECT_NE(shot(""), shot(".2")) << "the edited shader draws";
    EXPECT_EQ(shot(".2"), shot(".3")) << "the broken one does not";
    EXPECT_EQ(shot(""), shot(".4"));
}

TEST_F(View, PresetsAndParametersComeBack)
{
    Viewer viewer(scratch, {"plane", "--size", "240x135", "--technique", "blurred_depth"});
    fs::create_directories(scratch / "out");
    std::ofstream(scratch / "out/preset.json") << R"({"technique": "alias_free", "parameters": {"no_such": 1}})";
    viewer.click("section Files");
    viewer.click("load preset");
    EXPECT_NE(viewer.state()["message"].get<std::string>().find("no_such"), std::string::npos);
    EXPECT_EQ(viewer.state()["technique"], "blurred_depth") << "nothing of a bad preset is taken";
    std::ofstream(scratch / "out/preset.json") << R"({"technique": "shadow_map", "parameters": {"pcf": 7}})";
    viewer.click("load preset");
    EXPECT_EQ(viewer.state()["technique"], "shadow_map:pcf=7");
    viewer.click("save preset");
    viewer.click("technique blurred_depth");
    viewer.click("load preset");
    EXPECT_EQ(viewer.state()["technique"], "shadow_map:pcf=7");
    expect_silent(viewer.quit());
}

} // namespace
} // namespace gnomon::tests
