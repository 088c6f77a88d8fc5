// SPDX-License-Identifier: Apache-2.0
#include "panels.h"
#include "shadow/light_constants.h"
#include "widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

// Kind, size, colour and intensity of each light.
namespace gnomon::view {

namespace {

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

void light_power(Panels& panels, Session& session, size_t index)
{
    scene::Light light = session.stage().lights[index];
    float color[3] = {light.color.x, light.color.y, light.color.z};
    bool changed = ImGui::ColorEdit3("colour", color, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
    if (changed) light.color = {color[0], color[1], color[2]};
    panels.mark(index == 0 ? "light colour" : fmt::format("light colour {}", index + 1));
    ImGui::SameLine();
    bool given = light.intensity.has_value();
    const float fitted = shadow::effective_intensity(light, session.stage().bounds);
    if (ImGui::Checkbox("intensity", &given)) changed = true, light.intensity = given ? std::optional(fitted) : std::nullopt;
    panels.mark(index == 0 ? "light intensity" : fmt::format("light intensity {}", index + 1));
    if (ImGui::IsItemHovered()) tooltip("Of its own; otherwise what the light alone needs for an irradiance of pi at the scene's centre.");
    if (light.intensity) {
        float value = *light.intensity;
        if (ImGui::SliderFloat("##intensity", &value, 0.001f, 1e6f, "%.4g", ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
            changed = true, light.intensity = value;
    }
    if (changed) session.attempt([&] { session.light(index, light); });
}

} // namespace

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
        panels.mark(i == 0 ? "light size" : fmt::format("light size {}", i + 1));
        light_power(panels, session, i);
        ImGui::TextDisabled("%s", session.light_words()[i].substr(0, session.light_words()[i].find(',')).c_str());
        if (ImGui::IsItemHovered()) tooltip(session.light_words()[i]);
        ImGui::PopID();
    }
}

} // namespace gnomon::view
