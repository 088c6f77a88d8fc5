// SPDX-License-Identifier: Apache-2.0
#include "panels.h"
#include "widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

// One widget a parameter, from its description.
namespace gnomon::view {

namespace {

/// Ranges over several powers of ten get a logarithmic slider.
ImGuiSliderFlags slider_flags(const shadow::ParamInfo& info)
{
    const bool wide = info.range.min >= 0 && info.range.max >= 100 && info.range.max > 100 * info.range.min;
    return ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
}

std::string format_with_unit(const char* number, const std::string& unit)
{
    std::string text = number;
    if (unit.empty()) return text;
    text += ' ';
    for (const char c : unit) text += c == '%' ? std::string("%%") : std::string(1, c);
    return text;
}

void real_widget(Session& session, const shadow::ParamInfo& info)
{
    float value = float(session.left.params.get(info));
    if (ImGui::SliderFloat(info.name.c_str(), &value, float(info.range.min), float(info.range.max),
            format_with_unit("%.4g", info.unit).c_str(), slider_flags(info)))
        session.attempt([&] { session.left.params.set(info.name, double(value)); });
}

void integer_widget(Panels& panels, Session& session, const shadow::ParamInfo& info)
{
    const std::string key = std::string(session.left.info->id) + "." + info.name;
    const auto held = panels.pending.find(key);
    int value = held != panels.pending.end() ? held->second : int(session.left.params.get(info));
    if (ImGui::SliderInt(info.name.c_str(), &value, int(info.range.min), int(info.range.max), format_with_unit("%d", info.unit).c_str(),
            slider_flags(info)))
        panels.pending[key] = value;
    if (ImGui::IsItemActive() || !panels.pending.count(key)) return;
    session.attempt([&] { session.left.params.set(info.name, double(panels.pending[key])); });
    panels.pending.erase(key);
}

void choice_widget(Session& session, const shadow::ParamInfo& info)
{
    int index = int(session.left.params.get(info));
    if (combo(info.name.c_str(), index, info.choices)) session.attempt([&] { session.left.params.set(info.name, double(index)); });
}

void flag_widget(Session& session, const shadow::ParamInfo& info)
{
    bool on = session.left.params.get(info) != 0;
    if (ImGui::Checkbox(info.name.c_str(), &on)) session.attempt([&] { session.left.params.set(info.name, on ? 1.0 : 0.0); });
}

std::string help_of(const shadow::ParamInfo& info, const std::string& standard)
{
    std::string text = info.help;
    if (info.type == shadow::ParamType::real || info.type == shadow::ParamType::integer)
        text += fmt::format("\n{} to {}{}{}", info.range.min, info.range.max, info.unit.empty() ? "" : " ", info.unit);
    return text + "\ndefault: " + standard;
}

} // namespace

void parameter_section(Panels& panels, Session& session)
{
    const shadow::ParamValues defaults(session.left.info->params());
    if (session.left.params.table().fields.empty()) ImGui::TextDisabled("%s has none", std::string(session.left.info->id).c_str());
    // A copy: setting a value must not move what is walked through.
    const std::vector<shadow::ParamInfo> fields = session.left.params.table().fields;
    for (const shadow::ParamInfo& info : fields) {
        ImGui::PushID(info.name.c_str());
        const bool changed = session.left.params.get(info) != defaults.get(info);
        if (changed) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.85f, 0.45f, 1.0f));
        if (info.type == shadow::ParamType::real)
            real_widget(session, info);
        else if (info.type == shadow::ParamType::integer)
            integer_widget(panels, session, info);
        else if (info.type == shadow::ParamType::choice)
            choice_widget(session, info);
        else
            flag_widget(session, info);
        if (changed) ImGui::PopStyleColor();
        panels.mark("parameter " + info.name);
        if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) tooltip(help_of(info, defaults.text(info)));
        ImGui::PopID();
    }
    if (!fields.empty() && ImGui::Button("Reset to defaults")) session.reset_parameters();
    panels.mark("reset");
}

} // namespace gnomon::view
