// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"

#include <volk.h>

#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;

namespace gnomon::view {

/// A key that went down. Dear ImGui 1.86 only looks at what is down when a frame begins, and misses what is shorter than a frame.
struct Key {
    int key; ///< GLFW_KEY_*
    bool control;
};

/// A window for Vulkan. One at a time, in the main thread.
class Window {
public:
    /// Throws base::Error where there is no display.
    Window(const std::string& title, base::Size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    VkSurfaceKHR surface(VkInstance) const; ///< the caller destroys it
    base::Size pixels() const; ///< 0 x 0 while minimised
    bool closing() const;
    void close();
    void title(const std::string&);
    void clipboard(const std::string&);

    /// Handles what has happened; sleeps until something does, but no longer than `seconds` (negative: for ever, 0: not at all).
    void wait(double seconds);
    static void wake(); ///< from any thread: ends a wait
    uint64_t events() const { return events_; } ///< keys, buttons, moves, sizes ... so far
    void typing(bool on) { typing_ = on; } ///< whether characters and the repeats of a held key are events
    std::vector<std::string> dropped(); ///< files, since the last call
    std::vector<Key> pressed(); ///< since the last call

private:
    GLFWwindow* window_ = nullptr;
    uint64_t events_ = 0;
    bool typing_ = false;
    std::vector<std::string> dropped_;
    std::vector<Key> pressed_;
    friend struct WindowCallbacks;
};

} // namespace gnomon::view
