// SPDX-License-Identifier: Apache-2.0
#define GLFW_INCLUDE_NONE
#include "viewport.h"

#include "apps/view/ui.shared.h"
#include "controls.h"

#include <fmt/format.h>
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace gnomon::view {

namespace {

constexpr float radians_per_pixel = 0.006f;

void label(ImDrawList& list, float x, float y, const std::string& text)
{
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddRectFilled({x - 3, y - 2}, {x + size.x + 3, y + size.y + 2}, IM_COL32(0, 0, 0, 160), 3.0f);
    list.AddText({x, y}, IM_COL32(255, 220, 90, 255), text.c_str());
}

/// What the colours of the image that is inspected mean, from its lower left corner.
void draw_legend(ImDrawList& list, const Session& session, float x, float y)
{
    const Overlays& overlays = session.picture().overlays();
    const Overlays::Offer& shown = *overlays.offered();
    if (shown.label) return label(list, x + 4, y - 18, shown.name + ": a colour each");
    constexpr float width = 40, height = 12;
    const auto& colors = quantity_colors();
    const auto packed = [](vec3 c) { return ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1.0f}); };
    const std::string unit = shown.unit == "m" && session.overlays.in_pixels ? "pixels" : shown.unit;
    for (size_t i = 0; i + 1 < colors.size(); ++i) {
        const float left = x + float(i) * width;
        list.AddRectFilledMultiColor(
            {left, y - height}, {left + width, y}, packed(colors[i]), packed(colors[i + 1]), packed(colors[i + 1]), packed(colors[i]));
    }
    label(list, x + 4, y - height - 20, fmt::format("{}, {}: 0 to {:.3g} and more", shown.name, unit, overlays.most()));
}

ImTextureID fill(int which) { return reinterpret_cast<ImTextureID>(uintptr_t(which)); }

} // namespace

void Viewport::place(const Panels& panels, Session& session)
{
    const ImGuiIO& io = ImGui::GetIO();
    const float left = panels.hidden ? 0.0f : float(panel_width);
    const float width = std::max(io.DisplaySize.x - left, 1.0f), height = std::max(io.DisplaySize.y, 1.0f);
    if (panels.follow_window) session.attempt([&] { session.size({std::max(int(width), 16), std::max(int(height), 16)}); });
    const base::Size size = session.full_size();
    // At most as large as it is, unless the window is twice that: pixels stay pixels.
    float scale = std::min(width / float(size.width), height / float(size.height));
    if (scale > 1.0f) scale = std::floor(scale);
    const float w = std::max(float(size.width) * scale, 1.0f), h = std::max(float(size.height) * scale, 1.0f);
    rect_[0] = left + std::floor(0.5f * (width - w)), rect_[1] = std::floor(0.5f * (height - h));
    rect_[2] = rect_[0] + w, rect_[3] = rect_[1] + h;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddImage(fill(UI_CANVAS), {rect_[0], rect_[1]}, {rect_[2], rect_[3]});
    if (session.against != Against::nothing && session.look.show <= 1) {
        const float x = rect_[0] + session.look.split * w;
        list.AddLine({x, rect_[1]}, {x, rect_[3]}, IM_COL32(255, 220, 90, 255), 1.5f);
        const std::string right = session.against == Against::technique ? std::string(session.right.info->id) : "truth";
        const std::string own(session.left.info->id);
        label(list, x + 8, rect_[1] + 6, right);
        label(list, x - 8 - ImGui::CalcTextSize(own.c_str()).x, rect_[1] + 6, own);
    }
    if (session.picture().overlays().offered()) draw_legend(list, session, rect_[0] + 8, rect_[3] - 8);
    if (session.overlays.insets) {
        // Four layers beside one another, two rows: only those that there are.
        const uint32_t layers = session.picture().overlays().layers();
        const float columns = 0.25f * float(std::clamp(layers, 1u, 4u)), rows = layers > 4 ? 1.0f : 0.5f;
        const float inset = std::min(0.6f * w, 768.0f);
        list.AddImage(fill(UI_INSETS), {rect_[2] - columns * inset - 6, rect_[3] - 0.5f * rows * inset - 6}, {rect_[2] - 6, rect_[3] - 6},
            {0, 0}, {columns, rows});
    }
}

void Viewport::input(Panels& panels, Session& session, const std::vector<Key>& pressed, double seconds)
{
    const ImGuiIO& io = ImGui::GetIO();
    for (const Key& k : pressed) {
        if (k.control)
            panels.quit |= k.key == GLFW_KEY_Q;
        else if (!io.WantTextInput)
            key(k.key, panels, session);
    }
    flying_ = false;
    if (!io.WantTextInput && !io.KeyCtrl) fly(session, seconds);
    if (drag_ == Drag::none && !io.WantCaptureMouse) begin_drag(session);
    if (drag_ != Drag::none) drag(session);
    if (!io.WantCaptureMouse && io.MouseWheel != 0.0f)
        session.attempt([&] { session.camera(approach(session.stage().camera, io.MouseWheel)); });
}

void Viewport::key(int key, Panels& panels, Session& session)
{
    const auto toggle = [](bool& flag) { flag = !flag; };
    const auto step_technique = [&](long step) {
        const auto all = shadow::techniques();
        const long at = std::find(all.begin(), all.end(), session.left.info) - all.begin(), count = long(all.size());
        session.attempt([&] { session.technique(std::string(all[size_t((at + step + count) % count)]->id)); });
    };
    const auto show = [&](uint32_t what) { session.look.show = session.look.show == what ? 0 : what; };
    switch (key) {
    case GLFW_KEY_F1:
        return toggle(panels.help);
    case GLFW_KEY_TAB:
        return toggle(panels.hidden);
    case GLFW_KEY_ESCAPE:
        panels.help = false, session.message = {};
        return;
    case GLFW_KEY_T:
        return session.compare_with(session.against == Against::truth ? Against::nothing : Against::truth);
    case GLFW_KEY_X:
        show(2);
        if (session.look.show == 2 && session.against == Against::nothing) session.compare_with(Against::truth);
        return;
    case GLFW_KEY_V:
        return show(1);
    case GLFW_KEY_G:
        return toggle(session.look.wireframe);
    case GLFW_KEY_K:
        return toggle(session.overlays.layers);
    case GLFW_KEY_M:
        return toggle(session.overlays.insets);
    case GLFW_KEY_B:
        return toggle(session.overlays.volumes);
    case GLFW_KEY_N:
        return session.inspect_next();
    case GLFW_KEY_SPACE:
        panels.playing = !panels.playing && session.duration() > 0;
        return;
    case GLFW_KEY_HOME:
        return session.attempt([&] {
            const auto& own = session.stage().scene.cameras;
            session.camera(own.empty() ? scene::fit_camera(session.stage().bounds) : own.front());
        });
    case GLFW_KEY_F9:
        return session.attempt([&] { session.open(std::string(session.scene_name())); });
    case GLFW_KEY_P:
        panels.screenshot = true;
        return;
    case GLFW_KEY_O:
        panels.window_screenshot = true;
        return;
    case GLFW_KEY_C:
        panels.copy = true;
        return;
    case GLFW_KEY_R:
        panels.reload = true;
        return;
    case GLFW_KEY_PAGE_DOWN:
        return step_technique(1);
    case GLFW_KEY_PAGE_UP:
        return step_technique(-1);
    default:
        return;
    }
}

void Viewport::fly(Session& session, double seconds)
{
    const auto held = [](int key) { return ImGui::IsKeyDown(key) ? 1.0f : 0.0f; };
    const vec3 way(held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_E) - held(GLFW_KEY_Q), held(GLFW_KEY_W) - held(GLFW_KEY_S));
    flying_ = way != vec3(0);
    if (!flying_) return;
    // Across the scene in some ten seconds; a long wait (a window that slept) is no long way.
    const float speed = 0.2f * std::max(session.stage().bounds.radius(), 0.1f) * (ImGui::GetIO().KeyShift ? 10.0f : 1.0f);
    const float metres = speed * float(std::clamp(seconds, 0.001, 0.25));
    session.attempt([&] { session.camera(view::fly(session.stage().camera, metres * way)); });
}

void Viewport::begin_drag(Session& session)
{
    const ImGuiIO& io = ImGui::GetIO();
    const float split = rect_[0] + session.look.split * (rect_[2] - rect_[0]);
    const bool near_split = session.against != Against::nothing && session.look.show <= 1 && std::abs(io.MousePos.x - split) < 6.0f;
    if (near_split) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsMouseClicked(0))
        drag_ = ImGui::IsKeyDown(GLFW_KEY_L) ? Drag::light : near_split ? Drag::split : io.KeyShift ? Drag::slide : Drag::orbit;
    else if (ImGui::IsMouseClicked(1))
        drag_ = ImGui::IsKeyDown(GLFW_KEY_L) ? Drag::light_size : Drag::look;
    else if (ImGui::IsMouseClicked(2))
        drag_ = Drag::slide;
}

void Viewport::drag(Session& session)
{
    const ImGuiIO& io = ImGui::GetIO();
    const vec2 by(io.MouseDelta.x, io.MouseDelta.y);
    const float height = rect_[3] - rect_[1];
    const scene::Camera& camera = session.stage().camera;
    if (by != vec2(0))
        session.attempt([&] {
            if (drag_ == Drag::orbit)
                session.camera(orbit(camera, radians_per_pixel * by));
            else if (drag_ == Drag::look)
                session.camera(look(camera, radians_per_pixel * by));
            else if (drag_ == Drag::slide)
                session.camera(slide(camera, by, height));
            else if (drag_ == Drag::light)
                session.light(0, drag_light(session.stage().lights.front(), camera, by, height, io.KeyShift));
            else if (drag_ == Drag::light_size)
                session.light(0, resize_light(session.stage().lights.front(), by.x, 0.001f * session.stage().bounds.radius()));
            else
                session.look.split = std::clamp((io.MousePos.x - rect_[0]) / (rect_[2] - rect_[0]), 0.0f, 1.0f);
        });
    const int button = drag_ == Drag::look || drag_ == Drag::light_size ? 1 : drag_ == Drag::slide && ImGui::IsMouseDown(2) ? 2 : 0;
    if (!ImGui::IsMouseDown(button)) drag_ = Drag::none;
}

} // namespace gnomon::view
