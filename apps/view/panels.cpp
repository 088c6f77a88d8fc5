// SPDX-License-Identifier: Apache-2.0
#include "panels.h"

#include "widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace gnomon::view {

void Panels::mark(const std::string& name)
{
    if (!ImGui::IsItemVisible()) return;
    const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
    places[name] = {int(a.x), int(a.y), int(b.x), int(b.y)};
}

std::string refusal_of(const shadow::TechniqueInfo& info, const Session& session)
{
    for (const scene::Light& light : session.stage().lights) {
        const std::string reason = shadow::refusal(info, session.device(), light);
        if (!reason.empty()) return reason;
    }
    return {};
}

void technique_section(Panels& panels, Session& session)
{
    if (!ImGui::BeginListBox("##techniques", {-1, 7.3f * ImGui::GetTextLineHeightWithSpacing()})) return;
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        const std::string id(info->id), refused = refusal_of(*info, session);
        const bool chosen = info == session.left.info;
        if (!refused.empty()) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        if (ImGui::Selectable(id.c_str(), chosen)) session.attempt([&] { session.technique(id); });
        if (!refused.empty()) ImGui::PopStyleColor();
        panels.mark("technique " + id);
        if (ImGui::IsItemHovered())
            tooltip(fmt::format("{} ({}){}", info->title, info->cite, refused.empty() ? std::string() : "\n" + refused));
    }
    ImGui::EndListBox();
}

namespace {

bool section(Panels& panels, const char* name, bool open)
{
    const bool shown = ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    panels.mark(std::string("section ") + name);
    return shown;
}

void top_line(const Session& session)
{
    const base::Size size = session.stage().view.size;
    ImGui::Text("%s", session.scene_name().c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%d x %d%s  %.0f ms  F1: help", size.width, size.height, session.coarse() ? " (moving)" : "", session.draw_ms);
}

} // namespace

void draw_panels(Panels& panels, Session& session)
{
    panels.places.clear();
    if (!panels.hidden) {
        const ImGuiIO& io = ImGui::GetIO();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({float(panel_width), io.DisplaySize.y});
        ImGui::Begin("Gnomon", nullptr,
            ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar
                | ImGuiWindowFlags_NoNav);
        ImGui::PushItemWidth(-120);
        top_line(session);
        if (section(panels, "Technique", true)) technique_section(panels, session);
        if (section(panels, "Picture", true)) picture_section(panels, session);
        if (section(panels, "Light", true)) light_section(panels, session);
        if (section(panels, "Files", false)) file_section(panels, session);
        if (section(panels, "Camera and scene", false)) camera_section(panels, session);
        if (section(panels, "Times", true)) times_section(panels, session);
        if (section(panels, "Parameters", true)) parameter_section(panels, session);
        ImGui::PopItemWidth();
        ImGui::End();
    }
    draw_messages(panels, session);
    if (panels.help) draw_help(panels);
}

void draw_messages(Panels& panels, Session& session)
{
    const std::string standing = session.standing_error();
    const std::string& text = standing.empty() ? session.message.text : standing;
    if (text.empty()) return;
    const ImGuiIO& io = ImGui::GetIO();
    const bool error = !standing.empty() || session.message.error;
    const float left = panels.hidden ? 0.0f : float(panel_width);
    ImGui::SetNextWindowPos({left + 8, io.DisplaySize.y - 8}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {std::max(io.DisplaySize.x - left - 16, 100.0f), io.DisplaySize.y});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, error ? ImVec4(0.35f, 0.06f, 0.06f, 0.95f) : ImVec4(0.1f, 0.1f, 0.12f, 0.9f));
    ImGui::Begin("##message", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    ImGui::PushTextWrapPos(std::max(io.DisplaySize.x - left - 40, 80.0f));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    if (standing.empty() && ImGui::IsItemClicked()) session.message = {};
    ImGui::End();
    ImGui::PopStyleColor();
}

void draw_help(Panels& panels)
{
    static constexpr const char* lines[][2] = {{"left drag", "turn around the target"}, {"right drag", "look around"},
        {"middle drag, shift + left drag", "slide across the view"}, {"wheel", "nearer, farther"},
        {"W A S D, Q E", "fly; with shift ten times as fast"},
        {"L + left drag", "turn the sun, or move the light across the view (with shift: along it)"}, {"drag the line", "move the split"},
        {"T", "split: truth on the right, or nothing"}, {"X", "error map"}, {"V", "visibility"},
        {"Page up, Page down", "previous, next technique"}, {"L + right drag", "the light's size"},
        {"G, K, M", "wireframe, layers of the light map, the map itself"},
        {"B, N", "shadow volumes; what the technique offers: penumbra, pages"}, {"Space", "play the scene's animation"},
        {"Home", "the scene's first camera"}, {"P, O", "screenshot of the picture, of the window"},
        {"C", "copy the command line that renders this view"}, {"R", "recompile changed shaders"}, {"F9", "load the scene again"},
        {"Tab", "hide the panel"}, {"Esc", "close this, or the message"}, {"Ctrl + Q", "quit"}};
    ImGui::SetNextWindowPos({float(panel_width) + 40.0f, 60.0f}, ImGuiCond_Appearing);
    ImGui::Begin("Keys and mouse", &panels.help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& line : lines) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line[0]);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line[1]);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void times_section(Panels&, Session& session)
{
    double sum = 0;
    for (const std::string& name : session.time_order) {
        ImGui::Text("%8.2f ms", session.times[name]);
        ImGui::SameLine();
        ImGui::TextUnformatted(name.c_str());
        sum += session.times[name];
    }
    ImGui::Text("%8.2f ms", sum);
    ImGui::SameLine();
    ImGui::TextDisabled("in all; %.1f pictures a second", session.draw_ms > 0 ? 1000.0 / session.draw_ms : 0.0);
}

} // namespace gnomon::view
