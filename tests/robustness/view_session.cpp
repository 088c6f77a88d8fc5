// SPDX-License-Identifier: Apache-2.0
#include "view_session.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace gnomon::tests {

namespace {

bool there(const char* program) { return std::system(("command -v " + std::string(program) + " >/dev/null 2>&1").c_str()) == 0; }

/// What a window manager does when its cross is clicked (ICCCM 4.2.8.1), which xdotool cannot: a WM_DELETE_WINDOW message. By libX11, which
/// GLFW has brought along, without its headers, which it has not.
void ask_to_close(const std::string& display_name, unsigned long window)
{
    struct ClientMessage { // XClientMessageEvent, padded to XEvent
        int type = 33;
        unsigned long serial = 0;
        int send_event = 1;
        void* display = nullptr;
        unsigned long window = 0, message_type = 0;
        int format = 32;
        long data[5] = {}, padding[12] = {};
    };
    void* library = ::dlopen("libX11.so.6", RTLD_NOW);
    ASSERT_NE(library, nullptr) << ::dlerror();
    const auto open = reinterpret_cast<void* (*)(const char*)>(::dlsym(library, "XOpenDisplay"));
    const auto atom = reinterpret_cast<unsigned long (*)(void*, const char*, int)>(::dlsym(library, "XInternAtom"));
    const auto send = reinterpret_cast<int (*)(void*, unsigned long, int, long, ClientMessage*)>(::dlsym(library, "XSendEvent"));
    const auto close = reinterpret_cast<int (*)(void*)>(::dlsym(library, "XCloseDisplay"));
    void* display = open(display_name.c_str());
    ASSERT_NE(display, nullptr);
    ClientMessage message;
    message.window = window, message.message_type = atom(display, "WM_PROTOCOLS", 0);
    message.data[0] = long(atom(display, "WM_DELETE_WINDOW", 0));
    EXPECT_NE(send(display, window, 0, 0, &message), 0);
    close(display); // flushes
}

void nap(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

} // namespace

std::string no_windows(const Scratch& scratch)
{
    for (const char* program : {"Xvfb", "xdotool"})
        if (!there(program)) return std::string(program) + " is not installed (Debian: xvfb, xdotool)";
    const Finished tried = run_gnomon({"view", "plane"}, scratch.folder(), {.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}});
    return tried.err.find("built without its window") == std::string::npos ? "" : "gnomon was built without its window";
}

Display::Display()
{
    int ends[2];
    if (::pipe(ends) != 0) return;
    server_ = ::fork();
    if (server_ == 0) {
        ::close(ends[0]);
        const int nothing = ::open("/dev/null", O_RDWR);
        ::dup2(nothing, 1), ::dup2(nothing, 2);
        const std::string fd = std::to_string(ends[1]);
        ::execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "1400x900x24", "-nolisten", "tcp", nullptr);
        ::_exit(127);
    }
    ::close(ends[1]);
    char c = 0;
    while (::read(ends[0], &c, 1) == 1 && c != '\n') name_ += c;
    ::close(ends[0]);
    if (!name_.empty()) name_ = ":" + name_;
}

Display::~Display()
{
    if (server_ <= 0) return;
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
}

Viewer::Viewer(const Scratch& scratch, std::vector<std::string> arguments, std::map<std::string, std::string> environment)
    : folder_(scratch.folder())
{
    arguments.insert(arguments.begin(), "view");
    for (const char* word : {"--state", "state.json", "--validation"}) arguments.emplace_back(word);
    environment.insert({{"DISPLAY", display_.name()}, {"WAYLAND_DISPLAY", ""}, {"XDG_RUNTIME_DIR", folder_}});
    const RunOptions options{.environment = environment, .seconds = 240};
    run_ = std::async(std::launch::async, [=, folder = folder_] { return run_gnomon(arguments, folder, options); });
    wait(
        "the window's first picture", [](const Json& s) { return s.value("idle", false); }, 120);
}

Viewer::~Viewer()
{
    if (run_.valid()) quit();
}

Viewer::Json Viewer::state() const { return Json::parse(read_whole(folder_ / "state.json"), nullptr, false); }

bool Viewer::wait(const char* what, const std::function<bool(const Json&)>& until, double seconds) const
{
    const auto begin = std::chrono::steady_clock::now();
    for (;;) {
        const Json now = state();
        if (now.is_object() && until(now)) return true;
        const bool over = run_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        if (over || std::chrono::steady_clock::now() - begin > std::chrono::duration<double>(seconds)) {
            ADD_FAILURE() << (over ? "the program ended before " : "waited in vain for ") << what << "; " << read_whole(folder_ / ".err")
                          << now.dump(1);
            return false;
        }
        nap(0.05);
    }
}

bool Viewer::settled() const
{
    nap(0.3); // events take their way through the X server
    return wait("rest", [](const Json& s) { return s.value("idle", false); });
}

void Viewer::tool(const std::string& words) const
{
    const std::string command = "DISPLAY=" + display_.name() + " xdotool " + words + " >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

void Viewer::window(const std::string& command) const
{
    std::string words = command;
    words.replace(words.find('%'), 1, "$(DISPLAY=" + display_.name() + " xdotool search --name '^Gnomon: ' | tail -n 1)");
    tool(words);
}

void Viewer::key(const std::string& name) const
{
    tool("key " + name);
    settled();
}

Viewer::Json Viewer::place(const std::string& widget) const
{
    const Json places = state().value("places", Json::object());
    if (places.contains(widget)) return places[widget];
    ADD_FAILURE() << "no widget '" << widget << "' is to be seen: " << places.dump();
    return nullptr;
}

void Viewer::click(const std::string& widget) const
{
    const Json p = place(widget);
    if (p.is_null()) return;
    // Held, since Dear ImGui wants to see the mouse above the widget before it goes down.
    tool("mousemove " + std::to_string(p[0].get<int>() + 8) + " " + std::to_string((p[1].get<int>() + p[3].get<int>()) / 2)
        + " sleep 0.3 mousedown 1 sleep 0.3 mouseup 1");
    settled();
}

void Viewer::slide(const std::string& widget, double part) const
{
    const Json p = place(widget);
    if (p.is_null()) return;
    const int left = p[0].get<int>() + 3, right = p[2].get<int>();
    drag_in_window(left, (p[1].get<int>() + p[3].get<int>()) / 2, int(part * (right - left)), 0, 1);
}

void Viewer::hold(const std::string& name, const char* what, const std::function<bool(const Json&)>& until) const
{
    tool("keydown " + name);
    wait(what, until);
    tool("keyup " + name);
    settled();
}

void Viewer::drag(int x, int y, int by_x, int by_y, int button) const
{
    const Json p = state()["picture"];
    drag_in_window(x + p[0].get<int>(), y + p[1].get<int>(), by_x, by_y, button);
}

void Viewer::drag_in_window(int x, int y, int by_x, int by_y, int button) const
{
    const auto at
        = [&](int part) { return " mousemove " + std::to_string(x + by_x * part / 4) + " " + std::to_string(y + by_y * part / 4); };
    const std::string which = std::to_string(button);
    tool(at(0) + " sleep 0.3 mousedown " + which + " sleep 0.3" + at(1) + " sleep 0.2" + at(2) + " sleep 0.2" + at(4)
        + " sleep 0.4 mouseup " + which);
    settled();
}

Finished Viewer::quit()
{
    tool("key ctrl+q");
    return run_.get();
}

Finished Viewer::close()
{
    const std::filesystem::path file = folder_ / "window";
    EXPECT_EQ(std::system(("DISPLAY=" + display_.name() + " xdotool search --name '^Gnomon: ' >" + file.string()).c_str()), 0);
    ask_to_close(display_.name(), std::stoul("0" + read_whole(file)));
    return run_.get();
}

void WithWindows::SetUp()
{
    const std::string reason = no_windows(scratch);
    if (!reason.empty()) GTEST_SKIP() << reason;
}

void expect_silent(const Finished& f)
{
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_EQ(f.signal, 0);
    EXPECT_FALSE(f.timed_out);
    EXPECT_EQ(f.err, "") << "validation and all else";
}

} // namespace gnomon::tests
