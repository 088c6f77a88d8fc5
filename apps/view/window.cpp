// SPDX-License-Identifier: Apache-2.0
#define GLFW_INCLUDE_NONE
#include "window.h"

#include "base/error.h"
#include "gpu/functions.h"

#include <GLFW/glfw3.h>

#include <utility>

namespace gnomon::view {

/// Only counts: what happened is asked of GLFW and Dear ImGui. Dear ImGui's own callbacks call these.
struct WindowCallbacks {
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
    template <class... Args> static void count(GLFWwindow* window, Args...) { ++of(window).events_; }
    static void key(GLFWwindow* window, int key, int, int action, int mods)
    {
        if (action != GLFW_REPEAT || of(window).typing_) ++of(window).events_;
        if (action == GLFW_PRESS) of(window).pressed_.push_back({key, (mods & GLFW_MOD_CONTROL) != 0});
    }
    static void character(GLFWwindow* window, unsigned)
    {
        if (of(window).typing_) ++of(window).events_;
    }
    static void drop(GLFWwindow* window, int files, const char** names)
    {
        ++of(window).events_;
        for (int i = 0; i < files; ++i) of(window).dropped_.emplace_back(names[i]);
    }
};

namespace {

[[noreturn]] void fail_with_reason(const char* what)
{
    const char* text = nullptr;
    glfwGetError(&text);
    const std::string reason = text ? text : "no reason was given";
    glfwTerminate();
    base::fail("{}: {}; run where there is a display (DISPLAY or WAYLAND_DISPLAY), under `xvfb-run`, or make pictures with `gnomon render`",
        what, reason);
}

} // namespace

Window::Window(const std::string& title, base::Size size)
{
    glfwGetError(nullptr);
    if (!glfwInit()) fail_with_reason("no window can be opened");
    if (!glfwVulkanSupported()) fail_with_reason("no window for Vulkan can be opened");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    if (!window_) fail_with_reason("no window can be opened");
    glfwSetWindowUserPointer(window_, this);
    glfwSetWindowSizeLimits(window_, 320, 200, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetKeyCallback(window_, WindowCallbacks::key);
    glfwSetCharCallback(window_, WindowCallbacks::character);
    glfwSetMouseButtonCallback(window_, WindowCallbacks::count<int, int, int>);
    glfwSetCursorPosCallback(window_, WindowCallbacks::count<double, double>);
    glfwSetCursorEnterCallback(window_, WindowCallbacks::count<int>);
    glfwSetScrollCallback(window_, WindowCallbacks::count<double, double>);
    glfwSetFramebufferSizeCallback(window_, WindowCallbacks::count<int, int>);
    glfwSetWindowRefreshCallback(window_, WindowCallbacks::count<>);
    glfwSetWindowIconifyCallback(window_, WindowCallbacks::count<int>);
    glfwSetWindowFocusCallback(window_, WindowCallbacks::count<int>);
    glfwSetWindowCloseCallback(window_, WindowCallbacks::count<>);
    glfwSetDropCallback(window_, WindowCallbacks::drop);
}

Window::~Window()
{
    glfwDestroyWindow(window_);
    glfwTerminate();
}

VkSurfaceKHR Window::surface(VkInstance instance) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    const VkResult result = glfwCreateWindowSurface(instance, window_, nullptr, &surface);
    if (result != VK_SUCCESS) {
        const char* text = nullptr;
        glfwGetError(&text);
        base::fail(
            "the device cannot show pictures in a window ({}: {}); choose another with --device, or make pictures with `gnomon render`",
            gpu::result_name(result), text ? text : "no reason was given");
    }
    return surface;
}

base::Size Window::pixels() const
{
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return {};
    base::Size size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return size;
}

bool Window::closing() const { return glfwWindowShouldClose(window_); }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::title(const std::string& text) { glfwSetWindowTitle(window_, text.c_str()); }
void Window::clipboard(const std::string& text) { glfwSetClipboardString(window_, text.c_str()); }

void Window::wait(double seconds)
{
    if (seconds < 0)
        glfwWaitEvents();
    else if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

void Window::wake() { glfwPostEmptyEvent(); }

std::vector<std::string> Window::dropped() { return std::exchange(dropped_, {}); }
std::vector<Key> Window::pressed() { return std::exchange(pressed_, {}); }

} // namespace gnomon::view
