// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panels.h"
#include "session.h"
#include "window.h"

namespace gnomon::view {

/// The picture in the window: where it lies, and what the mouse and keys do to camera, light and split there.
class Viewport {
public:
    void place(const Panels&, Session&); ///< the picture below the panels, its split line and the insets
    void input(Panels&, Session&, const std::vector<Key>&, double seconds); ///< since the last call
    bool moving() const { return drag_ != Drag::none || flying_; }
    bool flying() const { return flying_; } ///< a key is held: needs another picture without an event
    const float* rectangle() const { return rect_; } ///< left, top, right, bottom in the window

private:
    enum class Drag { none, orbit, look, slide, light, light_size, split };
    void key(int key, Panels&, Session&);
    void fly(Session&, double seconds);
    void begin_drag(Session&);
    void drag(Session&);

    float rect_[4] = {0, 0, 1, 1};
    Drag drag_ = Drag::none;
    bool flying_ = false;
};

} // namespace gnomon::view
