// SPDX-License-Identifier: Apache-2.0
#include "widgets.h"

#include <imgui.h>

namespace gnomon::view {

void tooltip(const std::string& text)
{
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 32.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool combo(const char* label, int& index, const std::vector<std::string>& names)
{
    bool changed = false;
    const bool known = index >= 0 && size_t(index) < names.size();
    if (!ImGui::BeginCombo(label, known ? names[size_t(index)].c_str() : "", ImGuiComboFlags_HeightLarge)) return false;
    for (size_t i = 0; i < names.size(); ++i)
        if (ImGui::Selectable(names[i].c_str(), int(i) == index) && int(i) != index) index = int(i), changed = true;
    ImGui::EndCombo();
    return changed;
}

} // namespace gnomon::view
