// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <future>
#include <string>
#include <sys/types.h>
#include <vector>

// Drives `gnomon view` as a user does: an X server without a screen, a mouse and a keyboard made of xdotool.
namespace gnomon::tests {

/// Why windows cannot be tested here; "" = they can.
std::string no_windows(const Scratch&);

/// Its own X server for as long as it lives.
class Display {
public:
    Display();
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    const std::string& name() const { return name_; } ///< ":7"; "" where it did not start

private:
    pid_t server_ = 0;
    std::string name_;
};

/// A running viewer. Waiting for what never comes fails the test.
class Viewer {
public:
    Viewer(const Scratch&, std::vector<std::string> arguments, std::map<std::string, std::string> environment = {});
    ~Viewer(); ///< quits it

    using Json = nlohmann::json;
    Json state() const; ///< what its state file says; null before the first
    bool wait(const char* what, const std::function<bool(const Json&)>& until, double seconds = 60) const;
    bool settled() const; ///< waits until all is drawn
    void tool(const std::string& words) const; ///< xdotool
    void key(const std::string& name) const;
    void click(const std::string& widget) const; ///< by its name among the state's places
    void drag(int x, int y, int by_x, int by_y, int button = 1) const; ///< in the picture, from its corner
    void window(const std::string& command) const; ///< xdotool windowsize WINDOW ...: "windowsize % 800 600", % being the window
    /// Drags a slider from its left end to this part of its width, its label included.
    void slide(const std::string& widget, double part) const;
    void hold(const std::string& name, const char* what, const std::function<bool(const Json&)>& until) const; ///< a key, until then
    Finished quit();
    Finished close(); ///< as the window manager does

private:
    Json place(const std::string& widget) const; ///< null where it is not to be seen
    void drag_in_window(int x, int y, int by_x, int by_y, int button) const;

    std::filesystem::path folder_;
    Display display_;
    std::future<Finished> run_;
};

/// Skipped where there can be no windows.
class WithWindows : public testing::Test {
protected:
    void SetUp() override;
    Scratch scratch;
};

/// It ended as a user wants it: code 0, and not a word of complaint, validation's included.
void expect_silent(const Finished&);

} // namespace gnomon::tests
