// SPDX-License-Identifier: Apache-2.0
#include "panels.h"
#include "widgets.h"

#include "base/error.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

// What is shown, and beside what; light, camera, scene, files.
namespace gnomon::view {

namespace {

void against_combo(Panels& panels, Session& session)
{
    std::vector<std::string> names = {"nothing", "truth"};
    for (const shadow::TechniqueInfo* info : shadow::techniques()) names.emplace_back(info->id);
    int index = int(session.against);
    if (session.against == Against::technique)
        index = int(std::find(names.begin() + 2, names.end(), session.right.info->id) - names.begin());
    if (combo("beside", index, names))
        session.attempt([&] {
            const Against what = index == 0 ? Against::nothing : index == 1 ? Against::truth : Against::technique;
            session.compare_with(what, names[size_t(index)]);
        });
    panels.mark("beside");
    if (session.against == Against::truth) {
        const int samples = session.truth_samples();
        const char* more = session.truth_finished() ? "" : ", more to come";
        ImGui::TextDisabled("%s", samples == 0 ? "tracing ..." : fmt::format("samples a pixel: {}{}", samples, more).c_str());
    } else if (session.against == Against::technique) {
        ImGui::TextDisabled("%s", lab::choice_text(session.right).c_str());
        if (ImGui::SmallButton("take the parameters of the left side")) session.right = session.left;
    }
}

void size_combo(Panels& panels, Session& session)
{
    std::vector<base::Size> sizes = {{}, {320, 180}, {480, 270}, {640, 360}, {960, 540}, {1280, 720}, {1920, 1080}};
    if (std::find(sizes.begin(), sizes.end(), session.full_size()) == sizes.end()) sizes.push_back(session.full_size());
    std::vector<std::string> names = {"as the window"};
    for (size_t i = 1; i < sizes.size(); ++i) names.push_back(fmt::format("{} x {}", sizes[i].width, sizes[i].height));
    int index = panels.follow_window ? 0 : int(std::find(sizes.begin() + 1, sizes.end(), session.full_size()) - sizes.begin());
    if (combo("size", index, names)) {
        panels.follow_window = index == 0;
        if (index > 0) session.attempt([&] { session.size(sizes[size_t(index)]); });
    }
    panels.mark("size");
}

/// Of scenes that move. The scene is loaded anew for each moment.
void time_slider(Panels& panels, Session& session)
{
    if (!(session.duration() > 0)) return;
    float seconds = float(session.time());
    if (ImGui::SliderFloat("time", &seconds, 0, float(session.duration()), "%.2f s", ImGuiSliderFlags_AlwaysClamp))
        session.attempt([&] { session.time(double(seconds)); });
    panels.mark("time");
    ImGui::SameLine();
    if (ImGui::SmallButton(panels.playing ? "stop" : "play")) panels.playing = !panels.playing;
    panels.mark("play");
}

void overlay_section(Panels& panels, Session& session)
{
    OverlayWish& o = session.overlays;
    const auto flag = [&](const char* name, bool& on) {
        ImGui::Checkbox(name, &on);
        panels.mark(name);
    };
    flag("wireframe", session.look.wireframe);
    ImGui::SameLine();
    flag("map layers", o.layers);
    ImGui::SameLine();
    flag("map", o.insets);
    flag("volumes", o.volumes);
    if (ImGui::IsItemHovered())
        tooltip("Silhouettes as the light's centre sees them, yellow, and the sides of the shadow volumes from there on, blue; faint "
                "behind surfaces.");
    ImGui::SameLine();
    bool on = o.inspect >= 0;
    if (ImGui::Checkbox("inspect", &on)) o.inspect = on ? 0 : -1;
    panels.mark("inspect");
    if (ImGui::IsItemHovered())
        tooltip("What the technique found on its way: the penumbra's estimated width, pages and levels of a virtual map.");
    const auto& offers = session.picture().overlays().offers();
    if (o.inspect < 0 || offers.empty()) return;
    std::vector<std::string> names;
    for (const Overlays::Offer& offer : offers) names.push_back(offer.name);
    o.inspect = std::min(o.inspect, int(names.size()) - 1);
    combo("image", o.inspect, names);
    panels.mark("image");
    if (offers[size_t(o.inspect)].label) return;
    flag("in pixels", o.in_pixels);
    ImGui::SliderFloat("colours, octaves", &o.scale, -6, 6, "%+.1f", ImGuiSliderFlags_AlwaysClamp);
}

/// True where Enter was pressed.
bool words_input(const char* label, std::string& text) { return ImGui::InputText(label, &text, ImGuiInputTextFlags_EnterReturnsTrue); }

} // namespace

void picture_section(Panels& panels, Session& session)
{
    int show = int(session.look.show);
    if (combo("show", show, show_names())) session.look.show = uint32_t(show);
    panels.mark("show");
    against_combo(panels, session);
    size_combo(panels, session);
    ImGui::SliderFloat("exposure", &session.look.exposure, -6, 6, "%.2f stops", ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("ambient", &session.ambient, 0, 2, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    if (session.look.show == 2) {
        ImGui::SliderFloat("full colour at", &session.look.range, 0.01f, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
        ImGui::TextDisabled("red: left is too light, blue: too dark");
    }
    overlay_section(panels, session);
    ImGui::Checkbox("coarser while moving, where slow", &session.coarse_while_moving);
}

void camera_section(Panels& panels, Session& session)
{
    std::vector<std::string> cameras = {"fit"};
    for (const scene::Camera& c : session.stage().scene.cameras) cameras.push_back(c.name);
    int index = -1;
    if (combo("camera", index, cameras)) session.attempt([&] { session.camera(cameras[size_t(index)]); });
    scene::Camera camera = session.stage().camera;
    if (camera.half_height <= 0.0f) {
        float degrees = glm::degrees(camera.fov_y);
        if (ImGui::SliderFloat("field of view", &degrees, 5, 120, "%.1f degrees", ImGuiSliderFlags_AlwaysClamp)) {
            camera.fov_y = glm::radians(degrees);
            session.attempt([&] { session.camera(camera); });
        }
    }
    time_slider(panels, session);
    std::vector<std::string> scenes;
    for (const scene::Builtin& b : scene::builtins()) scenes.emplace_back(b.name);
    int chosen = int(std::find(scenes.begin(), scenes.end(), session.scene_name()) - scenes.begin());
    if (combo("scene", chosen, scenes)) session.attempt([&] { session.open(scenes[size_t(chosen)]); });
    if (words_input("file", panels.scene_file)) session.attempt([&] { session.open(panels.scene_file); });
    if (ImGui::Button("Load the scene again")) session.attempt([&] { session.open(std::string(session.scene_name())); });
    panels.mark("load again");
}

void file_section(Panels& panels, Session& session)
{
    words_input("preset", panels.preset_file);
    if (ImGui::Button("Save preset"))
        session.attempt([&] {
            session.save_preset(panels.preset_file);
            session.say("wrote " + panels.preset_file);
        });
    panels.mark("save preset");
    ImGui::SameLine();
    if (ImGui::Button("Load preset")) session.attempt([&] { session.load_preset(panels.preset_file); });
    panels.mark("load preset");
    words_input("picture", panels.screenshot_file);
    if (ImGui::IsItemHovered()) tooltip("A .png file; empty: a free name in out/");
    panels.screenshot |= ImGui::Button("Screenshot (P)");
    panels.mark("screenshot");
    ImGui::SameLine();
    panels.window_screenshot |= ImGui::Button("of the window (O)");
    panels.copy |= ImGui::Button("Copy the command line (C)");
    panels.mark("copy");
    panels.reload |= ImGui::Button("Recompile changed shaders (R)");
}

} // namespace gnomon::view
