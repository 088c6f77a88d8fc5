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

void light_size(Session& session, size_t index)
{
    scene::Light light = session.stage().lights[index];
    const float most = std::max(0.25f * session.stage().bounds.radius(), 1e-3f);
    bool changed = false;
    const auto slider = [&](const char* label, float& value, float low, float high, const char* format) {
        changed |= ImGui::SliderFloat(label, &value, low, high, format, ImGuiSliderFlags_AlwaysClamp);
    };
    if (auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) {
        float degrees = glm::degrees(2.0f * sun->angular_radius);
        slider("angle", degrees, 0, 30, "%.3g degrees");
        if (changed) sun->angular_radius = 0.5f * glm::radians(degrees);
    } else if (auto* spot = std::get_if<scene::SpotLight>(&light.shape)) {
        float cone = glm::degrees(2.0f * spot->outer_angle);
        slider("radius", spot->radius, 0, most, "%.3g m");
        slider("cone", cone, 1, 170, "%.3g degrees");
        if (changed) spot->outer_angle = 0.5f * glm::radians(cone), spot->inner_angle = std::min(spot->inner_angle, spot->outer_angle);
    } else if (auto* point = std::get_if<scene::PointLight>(&light.shape)) {
        slider("radius", point->radius, 0, most, "%.3g m");
    } else if (auto* disk = std::get_if<scene::DiskLight>(&light.shape)) {
        slider("radius", disk->radius, 0.001f * most, most, "%.3g m");
    } else {
        auto& rect = std::get<scene::RectLight>(light.shape);
        float width = 2 * glm::length(rect.half_u), height = 2 * glm::length(rect.half_v);
        slider("width", width, 0.002f * most, 2 * most, "%.3g m");
        slider("height", height, 0.002f * most, 2 * most, "%.3g m");
        if (changed) rect.half_u = 0.5f * width * glm::normalize(rect.half_u), rect.half_v = 0.5f * height * glm::normalize(rect.half_v);
    }
    if (changed) session.attempt([&] { session.light(index, light); });
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
    ImGui::Checkbox("wireframe", &session.look.wireframe);
    panels.mark("wireframe");
    ImGui::SameLine();
    ImGui::Checkbox("map layers", &session.look.layers);
    panels.mark("map layers");
    ImGui::SameLine();
    ImGui::Checkbox("map", &session.insets);
    panels.mark("map");
    ImGui::Checkbox("coarser while moving, where slow", &session.coarse_while_moving);
}

void light_section(Panels& panels, Session& session)
{
    for (size_t i = 0; i < session.stage().lights.size(); ++i) {
        ImGui::PushID(int(i));
        std::vector<std::string> names = {"directional", "spot", "point", "rect", "disk"};
        for (const scene::Light& l : session.stage().scene.lights) names.push_back(l.name);
        int index = int(session.stage().lights[i].kind());
        if (combo("kind", index, names)) session.attempt([&] { session.light(i, names[size_t(index)]); });
        panels.mark(i == 0 ? "light kind" : fmt::format("light kind {}", i + 1));
        light_size(session, i);
        if (ImGui::IsItemVisible()) panels.mark(i == 0 ? "light size" : fmt::format("light size {}", i + 1));
        ImGui::TextDisabled("%s", session.light_words()[i].substr(0, session.light_words()[i].find(',')).c_str());
        if (ImGui::IsItemHovered()) tooltip(session.light_words()[i]);
        ImGui::PopID();
    }
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
