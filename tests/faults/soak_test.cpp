// SPDX-License-Identifier: Apache-2.0
// Frames with changing scene, light, size and technique, in one process and on one device: nothing grows.
#include "fault_driver.h"
#include "lab/folder.h"
#include "lab/render.h"
#include "reliability.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <unistd.h>

namespace gnomon::tests {
namespace {

struct FramePlan {
    const shadow::TechniqueInfo* info;
    std::string scene, light;
    base::Size size;
};

std::string light_of(const std::string& kind, size_t n)
{
    if (kind == "directional") return fmt::format("sun,elevation={},azimuth={},angle={}", 25 + n * 7 % 60, n * 37 % 360, n % 3);
    const std::string place = fmt::format(",position={}/4/{}", float(n % 5) - 2.0f, float(n % 3) - 1.0f);
    if (kind == "spot") return "spot,target=0/0/0,cone=70,radius=0,intensity=40" + place;
    if (kind == "point") return "point,radius=0,intensity=40" + place;
    return kind + ",target=0/0/0,intensity=40" + place;
}

/// Every technique with each of its lights (a third of them in a short run), on scenes and sizes in turn.
std::vector<FramePlan> plan(const gpu::Device& device)
{
    const char* scenes[] = {"contact", "balls", "plane", "stacked_panes", "closed_box"};
    const base::Size sizes[] = {{64, 48}, {33, 71}, {96, 20}, {48, 48}};
    std::vector<FramePlan> out;
    size_t n = 0;
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        if (info->unavailable && !info->unavailable(device).empty()) continue;
        for (const std::string& kind : lab::claimed_kinds(*info)) {
            ++n;
            if (at_full_length() || n % 12 == 0) out.push_back({info, scenes[n % 5], light_of(kind, n), sizes[n % 4]});
        }
    }
    return out;
}

uint64_t resident_bytes()
{
    std::ifstream in("/proc/self/statm");
    uint64_t pages = 0;
    in >> pages >> pages;
    return pages * uint64_t(::sysconf(_SC_PAGESIZE));
}

/// What a process holds.
struct Held {
    uint64_t device_bytes, resident;
    int64_t handles;
};

TEST(Soak, NothingGrows)
{
    // Validation keeps records of its own and would be measured too.
    const auto below = gpu::Device::open({});
    FaultDriver& driver = FaultDriver::get();
    driver.forget();
    driver.arm({});
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Held> rounds;
    size_t frames = 0;
    {
        const auto device = adopt_with_faults(*below);
        const std::vector<FramePlan> frames_of_a_round = plan(*device);
        ASSERT_GT(frames_of_a_round.size(), 5u);
        const size_t wanted = at_full_length() ? 2000 : 4 * frames_of_a_round.size();
        // the first round makes the pipelines, the second finds the pools of a full round
        while (frames < wanted || rounds.size() < 4) {
            for (size_t n = 0; n < frames_of_a_round.size(); ++n, ++frames) {
                const FramePlan& f = frames_of_a_round[n];
                const lab::Stage stage = lab::open_stage({.scene = f.scene, .load = {.detail = 0.05}, .lights = {f.light}, .size = f.size});
                shadow::SceneGpu scene(*device, stage.scene);
                const lab::Rendered r = lab::render(
                    *device, scene, stage, lab::default_choice(*f.info), {.frame_index = uint32_t(frames), .lit = n % 2 == 0});
                ASSERT_EQ(r.images.size(), 1u);
            }
            rounds.push_back({device->allocated_bytes(), resident_bytes(), driver.live()});
        }
    }
    EXPECT_EQ(driver.living(), "") << "after the device";
    driver.forget();
    for (size_t i = 2; i < rounds.size(); ++i) {
        EXPECT_EQ(rounds[i].device_bytes, rounds[1].device_bytes) << "device memory, round " << i;
        EXPECT_EQ(rounds[i].handles, rounds[1].handles) << "handles, round " << i;
    }
    // Heaps and the driver's own pools settle; a leak of one frame's smallest image in each would be more.
    const int64_t grown = int64_t(rounds.back().resident) - int64_t(rounds[1].resident);
    EXPECT_LT(grown, int64_t(24) << 20);
    record("soak",
        {{"frames", frames}, {"rounds", rounds.size()}, {"device_mib", double(rounds.back().device_bytes) / 1048576.0},
            {"handles", rounds.back().handles}, {"resident_mib", double(rounds.back().resident) / 1048576.0},
            {"resident_grown_mib", double(grown) / 1048576.0}, {"failures", testing::Test::HasFailure()},
            {"seconds", std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()}});
}

} // namespace
} // namespace gnomon::tests
