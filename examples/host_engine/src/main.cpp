// SPDX-License-Identifier: Apache-2.0
// A small renderer that owns everything and takes its shadows from Gnomon: shadows.cpp is where they meet.
#include "renderer.h"
#ifdef HOST_ENGINE_WINDOW
#include "window.h"
#endif

#include <algorithm>
#include <cstdio>
#include <memory>
#include <random>
#include <stdexcept>

namespace host {

namespace {

#ifndef HOST_ENGINE_WINDOW
struct Window { // stands in for GLFW's
    Window(uint32_t, uint32_t) { throw std::runtime_error("built without GLFW: use --headless"); }
    static std::vector<const char*> instance_extensions() { return {}; }
    VkSurfaceKHR make_surface(VkInstance) const { return VK_NULL_HANDLE; }
    void attach(const Gpu&) { }
    bool open() { return false; }
    bool take_next() { return false; }
    void set_size(uint32_t, uint32_t) { }
    VkExtent2D extent() const { return {}; }
    VkSemaphore acquire(uint32_t) { return VK_NULL_HANDLE; }
    void show(VkCommandBuffer, const Image&) { }
    VkSemaphore shown() const { return VK_NULL_HANDLE; }
    void present() { }
    void destroyers(std::vector<std::function<void()>>&) { }
};
#endif

/// With --resize-every, sizes between 5/8 and all of the first one; the last frame has the first.
VkExtent2D size_of(const Options& o, uint32_t frame)
{
    if (o.resize_every == 0 || frame + 1 == o.frames) return {o.width, o.height};
    const uint32_t step = frame / o.resize_every % 4;
    return {o.width - o.width * step / 8, o.height - o.height * (step * 3 % 4) / 8};
}

void draw_frames(const Options& o, Renderer& renderer, Window* window)
{
    size_t technique = 0;
    for (uint32_t frame = 0; (o.frames == 0 || frame < o.frames) && (!window || window->open()); ++frame) {
        if (frame && frame % o.hold == 0 && o.frames) technique = (technique + 1) % o.techniques.size();
        if (window && window->take_next()) technique = (technique + 1) % o.techniques.size();
        const VkExtent2D wanted = size_of(o, frame);
        const VkCommandBuffer commands = renderer.begin(frame);
        VkSemaphore acquired = VK_NULL_HANDLE;
        if (window) {
            if (o.resize_every && (frame % o.resize_every == 0 || frame + 1 == o.frames)) window->set_size(wanted.width, wanted.height);
            acquired = window->acquire(frame);
        }
        // The window system may take its time over a size that was asked for; pictures of a fixed number of frames do not wait for it.
        renderer.resize(window && o.frames == 0 ? window->extent() : wanted);
        renderer.draw(frame, technique);
        if (window) window->show(commands, renderer.picture());
        renderer.submit(acquired, window ? window->shown() : VK_NULL_HANDLE);
        if (window) window->present();
    }
    renderer.finish();
}

void run(const Options& o)
{
    const std::unique_ptr<Window> window = o.headless ? nullptr : std::make_unique<Window>(o.width, o.height);
    std::function<VkSurfaceKHR(VkInstance)> make_surface;
    if (window) make_surface = [&](VkInstance instance) { return window->make_surface(instance); };
    std::vector<std::string> messages;
    {
        Gpu gpu(o.validation, window ? Window::instance_extensions() : std::vector<const char*>{}, make_surface);
        Options taken = o;
        Convention& c = taken.convention;
        // Devices have one 24-bit depth format or the other.
        constexpr VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
        if (!gpu.can_be(c.depth_format, needed)) c.depth_format = VK_FORMAT_D24_UNORM_S8_UINT;
        if (!gpu.can_be(c.depth_format, needed))
            throw std::runtime_error("this device has no 24-bit depth: use --depth reversed or forward");

        const Scene scene(gpu, c);
        Shadows shadows(gpu, scene, c, o.techniques, o.settings);
        Renderer renderer(gpu, scene, shadows, taken);
        if (window) window->attach(gpu);
        draw_frames(taken, renderer, window.get());
        if (!o.output.empty()) renderer.save(o.output);
        std::printf("%.1f MB in use by Gnomon\n", double(shadows.bytes()) * 1e-6);

        if (window) vkDeviceWaitIdle(gpu.device); // presentation has no fence
        std::vector<std::function<void()>> destroyers;
        destroyers.push_back([&] { gpu.destroy(scene.vertices); });
        destroyers.push_back([&] { gpu.destroy(scene.indices); });
        shadows.destroyers(destroyers);
        renderer.destroyers(destroyers);
        if (window) window->destroyers(destroyers);
        std::reverse(destroyers.begin(), destroyers.end());
        if (o.shuffle) std::shuffle(destroyers.begin(), destroyers.end(), std::mt19937(o.shuffle));
        for (const auto& destroy : destroyers) destroy();
        messages = gpu.messages;
    }
    for (const std::string& message : messages) std::fprintf(stderr, "%s\n", message.c_str());
    if (!messages.empty()) throw std::runtime_error(std::to_string(messages.size()) + " messages of the validation layer (above)");
}

} // namespace

} // namespace host

int main(int count, char** words)
{
    try {
        const host::Options options = host::parse(count, words);
        if (options.help)
            std::fputs(host::usage, stdout);
        else
            host::run(options);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "host_engine: %s\n", e.what());
        return 1;
    }
}
