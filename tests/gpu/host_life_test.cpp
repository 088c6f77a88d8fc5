// SPDX-License-Identifier: Apache-2.0
#include "host_fixture.h"

#include <algorithm>
#include <thread>

// What a renderer relies on between frames: nothing hidden, any order, any thread, errors that change nothing.
namespace gnomon::gpu {

namespace {

constexpr Size size{96, 64};
constexpr double near = 0.05;

/// Calls that the library may not make in a frame, counted behind its own loader.
struct Counts {
    std::atomic<int> submits = 0, waits = 0, allocations = 0;
};
Counts counts;
PFN_vkGetDeviceProcAddr real_device_proc = nullptr;

template <class Function> Function real(VkDevice device, const char* name)
{
    return reinterpret_cast<Function>(real_device_proc(device, name));
}

VKAPI_ATTR VkResult VKAPI_CALL count_allocate(VkDevice d, const VkMemoryAllocateInfo* i, const VkAllocationCallbacks* c, VkDeviceMemory* m)
{
    ++counts.allocations;
    return real<PFN_vkAllocateMemory>(d, "vkAllocateMemory")(d, i, c, m);
}
VKAPI_ATTR VkResult VKAPI_CALL count_submit(VkQueue, uint32_t, const VkSubmitInfo2*, VkFence)
{
    ++counts.submits;
    return VK_ERROR_UNKNOWN;
}
VKAPI_ATTR VkResult VKAPI_CALL count_wait(VkDevice d, uint32_t n, const VkFence* f, VkBool32 all, uint64_t time)
{
    ++counts.waits;
    return real<PFN_vkWaitForFences>(d, "vkWaitForFences")(d, n, f, all, time);
}
VKAPI_ATTR VkResult VKAPI_CALL count_idle(VkDevice d)
{
    ++counts.waits;
    return real<PFN_vkDeviceWaitIdle>(d, "vkDeviceWaitIdle")(d);
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL counted_device_proc(VkDevice device, const char* name)
{
    const std::string_view n = name;
    if (n == "vkAllocateMemory") return reinterpret_cast<PFN_vkVoidFunction>(count_allocate);
    if (n == "vkQueueSubmit" || n == "vkQueueSubmit2" || n == "vkQueueSubmit2KHR")
        return reinterpret_cast<PFN_vkVoidFunction>(count_submit);
    if (n == "vkWaitForFences") return reinterpret_cast<PFN_vkVoidFunction>(count_wait);
    if (n == "vkDeviceWaitIdle") return reinterpret_cast<PFN_vkVoidFunction>(count_idle);
    return real_device_proc(device, name);
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL counted_instance_proc(VkInstance instance, const char* name)
{
    if (std::string_view(name) != "vkGetDeviceProcAddr") return ::vkGetInstanceProcAddr(instance, name);
    real_device_proc = reinterpret_cast<PFN_vkGetDeviceProcAddr>(::vkGetInstanceProcAddr(instance, name));
    return reinterpret_cast<PFN_vkVoidFunction>(counted_device_proc);
}

} // namespace

class HostLife : public HostTest {
protected:
    /// A frame of the scene's own receivers, with an image for the result.
    struct Picture {
        Image image = HostTest::image("shadow", VK_FORMAT_R16_SFLOAT, size);
        gnomon_frame frame{};
        Picture(const scene::Scene& s, const char* light)
        {
            frame.light = host_light(scene::parse_light(light, {}, s.bounds()), {});
            aim(frame, s.cameras.empty() ? scene::fit_camera(s.bounds()) : s.cameras.front(), size, {}, near, 100);
            frame.output = host_image(image, VK_IMAGE_LAYOUT_UNDEFINED);
        }
        std::vector<float> values() const
        {
            Image left = device().adopt_image(image.handle(), image.desc(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
            return device().read_back(left).values;
        }
    };

    static std::vector<float> once(const gnomon::Device& library, const gnomon::Shadow& shadow, Picture& picture, Commands& commands)
    {
        picture.frame.commands = commands.begin();
        const uint64_t ticket = shadow.record(picture.frame);
        Commands::finish(picture.frame.commands);
        library.retire(ticket);
        return picture.values();
    }

    static scene::Scene floor_and_sheet() { return half_shadowed(); }
    static constexpr const char* sun = "directional,elevation=60,azimuth=20";
};

TEST_F(HostLife, NothingIsSubmittedWaitedForOrAllocatedAfterTheFirstFrames)
{
    const scene::Scene s = floor_and_sheet();
    const HostScene with_vertices = host_scene(s, {}, true), without = host_scene(s, {}, false);
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        if (info->unavailable && !info->unavailable(device()).empty()) continue;
        const HostScene& host = info->reads_vertices ? with_vertices : without; // those that do not say so must do without
        counts.submits = counts.waits = counts.allocations = 0;
        const gnomon::Device library(device_info(counted_instance_proc));
        const gnomon::Scene casters(library, host.info);
        const gnomon::Shadow shadow(casters, std::string(info->id));
        Picture picture(s, info->lights & shadow::directional_lights ? sun : "disk,position=0/4/0,radius=0.3");
        Commands commands;
        std::vector<uint64_t> flight;
        int allocations = 0;
        for (uint32_t i = 0; i < 10; ++i) {
            if (i == 5) allocations = counts.allocations;
            picture.frame.index = i;
            picture.frame.commands = commands.begin();
            flight.push_back(shadow.record(picture.frame));
            Commands::finish(picture.frame.commands);
            if (i > 0) library.retire(flight[i - 1]); // two frames in flight
        }
        library.retire(flight.back());
        EXPECT_EQ(counts.submits, 0) << info->id;
        EXPECT_EQ(counts.waits, 0) << info->id;
        EXPECT_EQ(counts.allocations, allocations) << info->id << " allocates device memory in every frame";
    }
}

TEST_F(HostLife, CastersMovedAndLightsMovedAreThoseOfAFreshScene)
{
    const scene::Scene before = floor_and_sheet();
    scene::Scene after = before;
    after.instances[1].world_from_object = glm::translate(mat4(1), vec3(0.75f, 1.5f, 0.5f));
    const HostScene host = host_scene(before, {}, true), moved = host_scene(after, {}, true);
    const gnomon::Device library(device_info());
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        if ((info->unavailable && !info->unavailable(device()).empty()) || info->id == std::string_view("virtual_shadow_map")) continue;
        const bool sunny = info->lights & shadow::directional_lights;
        const char *first = sunny ? sun : "disk,position=0/4/0,radius=0.3",
                   *second = sunny ? "directional,elevation=40,azimuth=130" : "disk,position=1/3/0,radius=0.5";
        Commands commands;
        const gnomon::Scene casters(library, host.info);
        const gnomon::Shadow shadow(casters, std::string(info->id));
        Picture a(before, first), b(after, second), c(after, second);
        const std::vector<float> old = once(library, shadow, a, commands);
        casters.move(1, moved.instances[1].transform);
        const std::vector<float> kept = once(library, shadow, b, commands);
        // its origin lies where the first scene's does
        const gnomon::Scene fresh_casters(library, host.info);
        fresh_casters.move(0, {moved.instances[0].transform, moved.instances[1].transform});
        const gnomon::Shadow fresh(fresh_casters, std::string(info->id));
        EXPECT_EQ(kept, once(library, fresh, c, commands)) << info->id;
        EXPECT_NE(kept, old) << info->id;
    }
}

TEST_F(HostLife, ObjectsGoInAnyOrder)
{
    const scene::Scene s = floor_and_sheet();
    const HostScene host = host_scene(s, {}, true);
    for (int order = 0; order < 6; ++order) {
        gnomon_device library{};
        gnomon_scene casters{};
        gnomon_shadow shadow{};
        gnomon_device_info info = device_info();
        ASSERT_EQ(gnomon_device_create(&info, &library), GNOMON_SUCCESS);
        ASSERT_EQ(gnomon_scene_create(library, &host.info, &casters), GNOMON_SUCCESS);
        ASSERT_EQ(gnomon_shadow_create(casters, "shadow_volumes", nullptr, &shadow), GNOMON_SUCCESS) << gnomon_error_message();
        Picture picture(s, sun);
        Commands commands;
        picture.frame.commands = commands.begin();
        uint64_t ticket = 0;
        ASSERT_EQ(gnomon_record(shadow, &picture.frame, &ticket), GNOMON_SUCCESS) << gnomon_error_message();
        // the scene and the shadow may go while their commands are still to run; the device only after
        const auto destroy = [&](int what) {
            if (what == 0) Commands::finish(picture.frame.commands), gnomon_device_destroy(library);
            if (what == 1) gnomon_scene_destroy(casters);
            if (what == 2) gnomon_shadow_destroy(shadow);
        };
        const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
        for (const int what : orders[order]) destroy(what);
        const std::vector<float> values = picture.values();
        EXPECT_LT(*std::min_element(values.begin(), values.end()), 0.5f) << "order " << order;
    }
}

TEST_F(HostLife, DevicesWorkInThreadsOfTheirOwn)
{
    const scene::Scene s = floor_and_sheet();
    constexpr int threads = 3;
    std::vector<HostScene> scenes;
    std::vector<std::unique_ptr<Picture>> pictures;
    std::vector<std::unique_ptr<Commands>> pools;
    for (int i = 0; i < threads; ++i) {
        scenes.push_back(host_scene(s, {}, true));
        pictures.push_back(std::make_unique<Picture>(s, sun));
        pools.push_back(std::make_unique<Commands>());
    }
    std::vector<gnomon::Device> devices;
    std::vector<uint64_t> tickets(threads);
    for (int i = 0; i < threads; ++i) devices.emplace_back(device_info());
    std::vector<gnomon::Scene> casters(threads);
    std::vector<gnomon::Shadow> shadows(threads);
    std::vector<std::thread> running;
    for (int i = 0; i < threads; ++i)
        running.emplace_back([&, i] {
            casters[size_t(i)] = gnomon::Scene(devices[size_t(i)], scenes[size_t(i)].info);
            shadows[size_t(i)] = gnomon::Shadow(casters[size_t(i)], "pcf");
            pictures[size_t(i)]->frame.commands = pools[size_t(i)]->begin();
            tickets[size_t(i)] = shadows[size_t(i)].record(pictures[size_t(i)]->frame);
        });
    for (std::thread& t : running) t.join();
    for (size_t i = 0; i < threads; ++i) {
        Commands::finish(pictures[i]->frame.commands);
        devices[i].retire(tickets[i]);
        EXPECT_EQ(pictures[i]->values(), pictures[0]->values());
    }
}

TEST_F(HostLife, WrongInputIsASentenceAndChangesNothing)
{
    const scene::Scene s = floor_and_sheet();
    const HostScene host = host_scene(s, {}, false);
    const gnomon::Device library(device_info());
    const gnomon::Scene casters(library, host.info);
    gnomon_shadow none{};
    const auto said = [](const char* part) { return std::string(gnomon_error_message()).find(part) != std::string::npos; };
    EXPECT_EQ(gnomon_shadow_create(casters.get(), "shadow_mop", nullptr, &none), GNOMON_ERROR_ARGUMENT);
    EXPECT_TRUE(said("shadow_map")) << gnomon_error_message();
    EXPECT_EQ(gnomon_shadow_create(casters.get(), "shadow_map", "map=large", &none), GNOMON_ERROR_ARGUMENT);
    EXPECT_EQ(gnomon_shadow_create(casters.get(), "shadow_volumes", nullptr, &none), GNOMON_ERROR_ARGUMENT);
    EXPECT_TRUE(said("positions")) << gnomon_error_message();
    EXPECT_EQ(none, nullptr);
    gnomon_device_info old = device_info();
    old.version = 100;
    gnomon_device device{};
    EXPECT_EQ(gnomon_device_create(&old, &device), GNOMON_ERROR_ARGUMENT);
    EXPECT_TRUE(said("0.1")) << gnomon_error_message();

    const gnomon::Shadow shadow(casters, "shadow_map");
    Picture picture(s, sun);
    Commands commands;
    picture.frame.commands = commands.begin();
    const auto refused = [&](void (*spoil)(gnomon_frame&), gnomon_result result) {
        gnomon_frame f = picture.frame;
        spoil(f);
        uint64_t ticket = 0;
        EXPECT_EQ(gnomon_record(shadow.get(), &f, &ticket), result) << gnomon_error_message();
        EXPECT_EQ(ticket, 0u);
        EXPECT_GT(std::strlen(gnomon_error_message()), 20u);
    };
    refused([](gnomon_frame& f) { f.clip_from_view[3] = NAN; }, GNOMON_ERROR_ARGUMENT);
    refused([](gnomon_frame& f) { std::fill_n(f.clip_from_view, 16, 0.0f); }, GNOMON_ERROR_ARGUMENT);
    refused([](gnomon_frame& f) { f.commands = VK_NULL_HANDLE; }, GNOMON_ERROR_ARGUMENT);
    refused([](gnomon_frame& f) { f.output.image = VK_NULL_HANDLE; }, GNOMON_ERROR_ARGUMENT);
    refused([](gnomon_frame& f) { f.output.format = VK_FORMAT_BC1_RGB_UNORM_BLOCK; }, GNOMON_ERROR_UNSUPPORTED);
    refused([](gnomon_frame& f) { f.depth = f.output, f.depth.extent.width = 5; }, GNOMON_ERROR_ARGUMENT);
    refused([](gnomon_frame& f) { f.light.kind = 9; }, GNOMON_ERROR_ARGUMENT);
    refused([](gnomon_frame& f) { f.light.kind = GNOMON_DISK, f.light.radius = 1; }, GNOMON_ERROR_UNSUPPORTED);
    refused([](gnomon_frame& f) { std::fill_n(f.light.direction, 3, 0.0f); }, GNOMON_ERROR_ARGUMENT);
    const uint64_t ticket = shadow.record(picture.frame); // the same commands are as good as before
    Commands::finish(picture.frame.commands);
    library.retire(ticket);
    EXPECT_LT(mean(picture.values()), 0.99);
}

TEST_F(HostLife, QualityLevelsRunAsChosen)
{
    const scene::Scene s = floor_and_sheet();
    const HostScene host = host_scene(s, {}, true);
    const gnomon::Device library(device_info());
    const gnomon::Scene casters(library, host.info);
    Commands commands;
    for (const char* light : {sun, "disk,position=0/4/0,radius=0.3"}) {
        Picture picture(s, light);
        for (uint32_t level = GNOMON_LOW; level <= GNOMON_EXACT; ++level) {
            const gnomon_choice choice = library.choose(level, picture.frame.light);
            const gnomon::Shadow shadow(casters, choice.technique, choice.settings);
            EXPECT_LT(mean(once(library, shadow, picture, commands)), 0.999) << choice.technique << " " << choice.settings;
            EXPECT_GT(choice.time, 0.0) << light;
        }
    }
    gnomon_choice none{};
    const Picture picture(s, sun);
    EXPECT_EQ(gnomon_choose(library.get(), 4, &picture.frame.light, &none), GNOMON_ERROR_ARGUMENT);
}

TEST_F(HostLife, TheCullingCallbackDecidesWhoCasts)
{
    const scene::Scene s = floor_and_sheet();
    const HostScene host = host_scene(s, {}, true);
    const gnomon::Device library(device_info());
    const gnomon::Scene casters(library, host.info);
    const gnomon::Shadow shadow(casters, "shadow_map");
    Picture picture(s, sun);
    Commands commands;
    struct Asked {
        int floor = 0, sheet = 0;
        bool keep = true;
    } asked;
    picture.frame.depth = {}; // the receivers are drawn too, and are asked about
    picture.frame.cull = [](void* user, uint32_t instance, const float(*planes)[4], uint32_t count) -> VkBool32 {
        Asked& a = *static_cast<Asked*>(user);
        ++(instance == 0 ? a.floor : a.sheet);
        for (uint32_t i = 0; i < count; ++i) EXPECT_NEAR(std::hypot(planes[i][0], planes[i][1], planes[i][2]), 1.0f, 1e-4f);
        return a.keep || instance == 0;
    };
    picture.frame.cull_user = &asked;
    const double with = mean(once(library, shadow, picture, commands));
    asked.keep = false;
    const double without = mean(once(library, shadow, picture, commands));
    EXPECT_GT(asked.floor, 0);
    EXPECT_GT(asked.sheet, 0);
    EXPECT_LT(with, 0.99);
    EXPECT_EQ(without, 1.0);
}

} // namespace gnomon::gpu
