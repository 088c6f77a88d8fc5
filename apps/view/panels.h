// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session.h"

#include <array>
#include <map>
#include <optional>
#include <string>

namespace gnomon::view {

inline constexpr int panel_width = 372; // pixels

/// What the panels keep, and what they ask of the window.
struct Panels {
    bool hidden = false, help = false, follow_window = false;
    bool playing = false; ///< the scene's animation
    bool screenshot = false, window_screenshot = false, copy = false, reload = false, quit = false; ///< asked for; the loop resets them
    std::string screenshot_file, preset_file = "out/preset.json", scene_file;
    std::map<std::string, int> pending; ///< whole numbers while their slider is held: each would be another pipeline
    std::map<std::string, std::array<int, 4>> places; ///< of widgets in the window: left, top, right, bottom

    void mark(const std::string& name); ///< the widget just made
};

void draw_panels(Panels&, Session&);
void draw_help(Panels&);
void draw_messages(Panels&, Session&);
/// Sections of the panel.
void technique_section(Panels&, Session&);
void parameter_section(Panels&, Session&);
void picture_section(Panels&, Session&);
void light_section(Panels&, Session&);
void camera_section(Panels&, Session&);
void times_section(Panels&, Session&);
void file_section(Panels&, Session&);

/// "" where the technique can draw this stage on this device, else why not.
std::string refusal_of(const shadow::TechniqueInfo&, const Session&);

} // namespace gnomon::view
