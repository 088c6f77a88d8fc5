// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace gnomon::view {

/// How fast the window followed a moving camera.
struct Pace {
    std::string name;
    std::vector<double> frames_ms; ///< from one picture in the window to the next
    double pictures_ms = 0; ///< of all that, the picture itself; the rest is the panel and the window system
    int coarse = 0; ///< frames at half the width and height
    std::map<std::string, double> passes_ms; ///< on the device, by name

    void add(double frame_ms, const Session&);
    double seconds() const;
    double frames_per_second() const;
    double slowest_ms() const; ///< that one frame in twenty takes at least
};

std::string paces_text(const std::vector<Pace>&, const Options&);
nlohmann::ordered_json paces_json(const std::vector<Pace>&, const Options&);

} // namespace gnomon::view
