// SPDX-License-Identifier: Apache-2.0
// Every call of a render that a driver may refuse is refused once: a sentence, nothing left behind, and the device goes on.
#include "base/error.h"
#include "fault_driver.h"
#include "lab/render.h"
#include "reliability.h"

#include <gtest/gtest.h>

#include <chrono>

namespace gnomon::tests {
namespace {

struct Subject {
    const char *technique, *light;
};
void PrintTo(const Subject& s, std::ostream* out) { *out << s.technique; }

class DeviceFaults : public testing::TestWithParam<Subject> {
protected:
    static void SetUpTestSuite() { below_ = gpu::Device::open({.validation = true}); }
    static void TearDownTestSuite() { below_.reset(); }
    void SetUp() override
    {
        const shadow::TechniqueInfo& info = shadow::technique(GetParam().technique);
        if (const std::string reason = info.unavailable ? info.unavailable(*below_) : ""; !reason.empty()) GTEST_SKIP() << reason;
        stage_ = lab::open_stage({.scene = "contact", .load = {.detail = 0.05}, .lights = {GetParam().light}, .size = {64, 48}});
        driver().arm({});
        seen_ = below_->validation_errors().size();
        begin_ = std::chrono::steady_clock::now();
    }
    void TearDown() override
    {
        for (size_t i = seen_; i < below_->validation_errors().size(); ++i) ADD_FAILURE() << below_->validation_errors()[i];
    }

    static FaultDriver& driver() { return FaultDriver::get(); }

    /// A scene's upload, a picture and its reading back.
    std::vector<float> picture(gpu::Device& device) const
    {
        shadow::SceneGpu scene(device, stage_.scene);
        const lab::Rendered r = lab::render(device, scene, stage_, lab::default_choice(shadow::technique(GetParam().technique)), {});
        std::vector<float> values = r.images.front().values;
        values.insert(values.end(), r.radiance.values.begin(), r.radiance.values.end());
        return values;
    }

    void expect_nothing_left(const std::string& where)
    {
        EXPECT_EQ(driver().living(), "") << where;
        driver().forget();
    }

    /// Opens a device and makes a picture with this fault in it. Returns the call that failed; "" where the fault lay beyond the last.
    std::string try_with(const Fault& fault, const std::vector<float>& right, bool goes_on)
    {
        driver().arm(fault);
        std::string failed;
        {
            std::unique_ptr<gpu::Device> device;
            try {
                device = adopt_with_faults(*below_);
                const std::vector<float> values = picture(*device);
                EXPECT_TRUE(values == right) << "another picture, and no word of it, after " << driver().failed() << " at " << fault.at;
            } catch (const base::Error& e) {
                EXPECT_GT(std::string(e.what()).size(), 40u) << "no sentence: " << e.what();
                ++refused_;
            } catch (const std::exception& e) {
                ADD_FAILURE() << driver().failed() << " at " << fault.at << " was called a programmer's error: " << e.what();
            }
            failed = driver().failed();
            driver().arm({});
            if (device && goes_on) {
                EXPECT_TRUE(picture(*device) == right) << "the device draws otherwise after " << failed << " at " << fault.at;
            }
        }
        expect_nothing_left(failed + " at " + std::to_string(fault.at));
        return failed;
    }

    /// The right picture, and how many calls of a kind it takes.
    std::vector<float> undisturbed(Fault::Among among, uint64_t& calls)
    {
        driver().arm({among, ~uint64_t(0), VK_SUCCESS});
        std::vector<float> values;
        {
            const auto device = adopt_with_faults(*below_);
            values = picture(*device);
            calls = driver().calls();
        }
        expect_nothing_left("an undisturbed run");
        return values;
    }

    void note(const char* fault, uint64_t calls, uint64_t tried)
    {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        RecordProperty("calls", std::to_string(calls));
        record("faults",
            {{"fault", fault}, {"technique", GetParam().technique}, {"calls", calls}, {"tried", tried}, {"refused", refused_},
                {"failures", HasFailure()}, {"seconds", seconds}});
    }

    inline static std::unique_ptr<gpu::Device> below_;
    lab::Stage stage_;
    uint64_t refused_ = 0; ///< runs that ended in a sentence; the others found a way and drew the right picture
    size_t seen_ = 0;
    std::chrono::steady_clock::time_point begin_;
};

TEST_P(DeviceFaults, OutOfMemoryAtAnyCallIsASentenceAndTheDeviceGoesOn)
{
    uint64_t calls = 0, tried = 0;
    const std::vector<float> right = undisturbed(Fault::Among::all, calls);
    ASSERT_GT(calls, 50u);
    for (uint64_t n = 0; n < calls; n += step_of(calls, 6), ++tried) {
        const VkResult result = tried % 2 ? VK_ERROR_OUT_OF_HOST_MEMORY : VK_ERROR_OUT_OF_DEVICE_MEMORY;
        EXPECT_NE(try_with({Fault::Among::all, n, result}, right, true), "");
    }
    EXPECT_GT(refused_, tried / 4);
    note("out of memory", calls, tried);
}

TEST_P(DeviceFaults, ALostDeviceIsASentence)
{
    uint64_t calls = 0, tried = 0;
    const std::vector<float> right = undisturbed(Fault::Among::queue, calls);
    ASSERT_GT(calls, 10u);
    for (uint64_t n = 0; n < calls; n += step_of(calls, 4), ++tried)
        EXPECT_NE(try_with({Fault::Among::queue, n, VK_ERROR_DEVICE_LOST}, right, false), "");
    EXPECT_EQ(refused_, tried);
    note("device lost", calls, tried);
}

constexpr const char *sun = "sun,elevation=50,azimuth=35,angle=0", *rect = "rect,position=2/5/1,target=0/0/0,intensity=40";
INSTANTIATE_TEST_SUITE_P(Techniques, DeviceFaults,
    testing::Values(Subject{"shadow_map", sun}, Subject{"pcss", rect}, Subject{"shadow_volumes", sun}, Subject{"per_triangle_volumes", sun},
        Subject{"ray_traced", rect}, Subject{"virtual_shadow_map", sun}),
    [](const auto& p) { return std::string(p.param.technique); });

} // namespace
} // namespace gnomon::tests
