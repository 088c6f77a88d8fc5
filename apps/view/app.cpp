// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "controls.h"
#include "pace.h"
#include "panels.h"
#include "session.h"
#include "swapchain.h"
#include "ui_draw.h"
#include "view.h"
#include "viewport.h"
#include "window.h"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace gnomon::view {

namespace {

using Clock = std::chrono::steady_clock;

/// Dear ImGui is one per process.
struct Gui {
    explicit Gui(const Window& window)
    {
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr; // leaves no file behind
        ImGui::StyleColorsDark();
        ImGui::GetStyle().WindowRounding = ImGui::GetStyle().FrameRounding = 3.0f;
        ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    }
    ~Gui()
    {
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;
};

base::Size window_size(base::Size picture)
{
    return {std::clamp(picture.width + panel_width, 900, 1900), std::clamp(picture.height, 760, 1040)};
}

class App {
public:
    explicit App(const Options& options)
        : options_(options)
        , device_(gpu::Device::open({options.device, options.validation}))
        , window_("Gnomon: " + options.stage.scene, window_size(options.stage.size))
        , session_(*device_, options, Window::wake)
        , gui_(window_)
        , swapchain_(*device_, window_.surface(device_->instance()))
        , ui_(*device_)
    {
    }

    int run()
    {
        while (!window_.closing() && !panels_.quit) {
            window_.wait(patience());
            notice();
            if (frames_due_ <= 0 || window_.pixels().area() == 0) continue;
            write_state(false);
            frame();
            window_.wait(0); // so that the state is not called idle while there are events
            notice();
            write_state(frames_due_ <= 0 && !viewport_.moving() && !panels_.playing);
        }
        return finish();
    }

    /// Goes around the target as a drag of the mouse would, at full size and then as a window without --measure would.
    int measure()
    {
        std::vector<Pace> paces;
        const scene::Camera start = session_.stage().camera;
        for (const bool coarse : {false, true}) {
            session_.coarse_while_moving = coarse;
            paces.push_back(go_around(start, coarse ? "coarser while moving, where slow" : "full size"));
        }
        fmt::print("{}", options_.json ? paces_json(paces, options_).dump(2) + "\n" : paces_text(paces, options_));
        return finish();
    }

private:
    int finish()
    {
        swapchain_.wait();
        const auto& errors = device_->validation_errors();
        if (!errors.empty()) base::fail("the validation layers found {} errors, the first: {}", errors.size(), errors.front());
        return 0;
    }

    Pace go_around(const scene::Camera& start, const char* name)
    {
        Pace pace{name};
        constexpr int warm = 5; // pipelines, and a first estimate of how long pictures take
        auto begin = Clock::now(), last = begin;
        for (int i = -warm; !window_.closing(); ++i) {
            window_.wait(0);
            if (window_.pixels().area() == 0) base::fail("the window was minimised, so that nothing was drawn to measure; leave it open");
            if (i == 0) begin = last = Clock::now();
            const double part = std::chrono::duration<double>(last - begin).count() / options_.measure;
            if (i >= 0 && part >= 1.0) break;
            driven_ = true;
            session_.attempt([&] { session_.camera(orbit(start, {i < 0 ? 0.0f : float(part) * 2.0f * pi, 0.0f})); });
            frame();
            const auto now = Clock::now();
            if (i >= 0) pace.add(std::chrono::duration<double, std::milli>(now - last).count(), session_);
            last = now;
        }
        driven_ = false;
        return pace;
    }

    /// Dear ImGui answers an event one or two frames later: a button is drawn pressed, then does what it does.
    static constexpr int settle = 3;

    double patience() const
    {
        if (window_.pixels().area() == 0) return -1;
        if (frames_due_ > 0 || viewport_.flying()) return 0;
        return ImGui::GetIO().WantTextInput ? 0.25 : -1; // a text cursor blinks
    }

    void notice()
    {
        if (window_.events() != events_) events_ = window_.events(), frames_due_ = settle;
        if (panels_.playing) frames_due_ = std::max(frames_due_, 1);
        if (session_.truth_moved()) frames_due_ = std::max(frames_due_, 1);
        for (const std::string& file : window_.dropped()) session_.attempt([&] { session_.open(file); });
    }

    void frame()
    {
        const auto now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        --frames_due_, ++frames_;
        swapchain_.wait(); // the pictures and buffers of the last frame are free again
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        viewport_.place(panels_, session_);
        draw_panels(panels_, session_);
        viewport_.input(panels_, session_, window_.pressed(), seconds);
        ImGui::Render();
        window_.typing(ImGui::GetIO().WantTextInput);
        if (panels_.playing) play(seconds);
        session_.attempt([&] { session_.update(panels_.playing || driven_ || viewport_.moving()); });
        if (viewport_.flying()) frames_due_ = std::max(frames_due_, 1);
        if (!swapchain_.present(window_.pixels(), [&](gpu::PassList& passes, gpu::ImageId target) { draw_ui(passes, target); }))
            frames_due_ = std::max(frames_due_, 1);
        serve();
    }

    /// By the clock; where loading is slow, in larger steps.
    void play(double seconds)
    {
        const double duration = session_.duration();
        if (!(duration > 0)) {
            panels_.playing = false;
            return;
        }
        const double time = session_.time() + std::min(seconds, 0.5 * duration);
        session_.attempt([&] {
            panels_.playing = false; // where it throws
            session_.time(time - std::floor(time / duration) * duration);
            panels_.playing = true;
        });
    }

    void draw_ui(gpu::PassList& passes, gpu::ImageId target)
    {
        ui_.record(passes, *ImGui::GetDrawData(), target, session_.picture().canvas(), session_.picture().insets());
    }

    /// What panels and keys have asked for, now that the picture is there.
    void serve()
    {
        if (panels_.copy) session_.attempt([&] { copy_command(); });
        if (panels_.screenshot && !viewport_.moving())
            session_.attempt([&] { session_.say("wrote " + session_.screenshot(panels_.screenshot_file).string()); });
        if (panels_.window_screenshot) session_.attempt([&] { screenshot_window(); });
        if (panels_.reload) session_.attempt([&] { session_.say(session_.reload_shaders()); });
        if (panels_.copy || panels_.screenshot || panels_.window_screenshot || panels_.reload) frames_due_ = settle;
        panels_.copy = panels_.screenshot = panels_.window_screenshot = panels_.reload = false;
    }

    void copy_command()
    {
        const std::string command = session_.command();
        window_.clipboard(command);
        fmt::print("{}\n", command);
        std::fflush(stdout);
        session_.say("copied: " + command);
    }

    void screenshot_window()
    {
        swapchain_.wait();
        gpu::Image copy = device_->image({VK_FORMAT_R8G8B8A8_UNORM, swapchain_.size(), 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "screenshot"});
        gpu::PassList passes(*device_);
        draw_ui(passes, passes.import(copy));
        device_->submit(std::move(passes));
        base::Picture rgba = device_->read_back(copy), rgb(rgba.size, 3);
        for (size_t i = 0; i < rgba.size.area(); ++i) std::copy_n(&rgba.values[i * 4], 3, &rgb.values[i * 3]);
        const std::filesystem::path file = panels_.screenshot_file.empty() ? "out/window.png" : panels_.screenshot_file;
        base::write_png(file, rgb, base::Encoding::linear);
        session_.say("wrote " + file.string());
    }

    std::string inspected() const
    {
        const Overlays::Offer* offer = session_.picture().overlays().offered();
        return offer ? offer->name : std::string();
    }

    void write_state(bool idle)
    {
        if (options_.state.empty()) return;
        const float* r = viewport_.rectangle();
        nlohmann::ordered_json json = {{"technique", lab::choice_text(session_.left)}, {"camera", session_.camera_words()},
            {"lights", session_.light_words()}, {"show", show_names()[session_.look.show]}, {"split", session_.look.split},
            {"against", int(session_.against)}, {"truth_samples", session_.truth_samples()}, {"truth_finished", session_.truth_finished()},
            {"message", session_.message.text}, {"error", session_.standing_error()}, {"draw_ms", session_.draw_ms}, {"frames", frames_},
            {"coarse", session_.coarse()}, {"time", session_.time()}, {"duration", session_.duration()}, {"inspected", inspected()},
            {"help", panels_.help}, {"command", session_.command()}, {"window", {swapchain_.size().width, swapchain_.size().height}},
            {"picture", {int(r[0]), int(r[1]), int(r[2]), int(r[3])}}, {"idle", idle}, {"places", panels_.places},
            {"times", session_.times}};
        session_.attempt([&] { base::write_text(options_.state, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace)); });
    }

    const Options& options_;
    std::unique_ptr<gpu::Device> device_;
    Window window_;
    Session session_;
    Gui gui_;
    Swapchain swapchain_;
    UiDraw ui_;
    Panels panels_;
    Viewport viewport_;
    uint64_t events_ = 0, frames_ = 0;
    int frames_due_ = settle;
    bool driven_ = false; ///< by `measure`
    Clock::time_point last_ = Clock::now();
};

} // namespace

int run(const Options& options)
{
    App app(options);
    return options.measure > 0 ? app.measure() : app.run();
}

} // namespace gnomon::view
