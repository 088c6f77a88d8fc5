// SPDX-License-Identifier: Apache-2.0
// What a reader expects of flicker, swimming and popping, on real techniques.
#include "lab/folder.h"

#include "base/error.h"
#include "lab/sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace gnomon::lab {
namespace {

class SequenceTest : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        const char* name = std::getenv("GNOMON_TEST_DEVICE");
        device_ = gpu::Device::open({name ? name : "", true});
    }
    static void TearDownTestSuite() { device_.reset(); }
    void TearDown() override { EXPECT_TRUE(device_->validation_errors().empty()) << device_->validation_errors().front(); }

    /// A scene, its light and its camera, at work.
    struct Place {
        StageOptions options;
        Stage stage;
        shadow::SceneGpu scene;
        explicit Place(const StageOptions& o)
            : options(o)
            , stage(open_stage(o))
            , scene(*device_, stage.scene)
        {
        }
        std::vector<lab::Run> measure(const std::string& motion, const std::vector<std::string>& techniques, int truth_samples = 16)
        {
            Sequence sequence(*device_, scene, stage, options, parse_motion(motion), {.truth_samples = truth_samples});
            std::vector<lab::Run> out;
            for (const std::string& text : techniques) {
                const Choice choice = parse_choice(text);
                out.push_back(new_run(stage, choice, "light"));
                sequence.measure(choice, out.back());
            }
            return out;
        }
    };

    static double change(const lab::Run& run) { return run.metrics.at("flicker") + run.metrics.at("swimming"); }

    inline static std::unique_ptr<gpu::Device> device_;
};

const StageOptions contact = {.scene = "contact", .lights = {"sun,elevation=40,azimuth=120"}, .size = {128, 72}};

TEST_F(SequenceTest, StableCascadesStayWhereTightOnesSwim)
{
    Place place({.scene = "contact", .size = {128, 72}});
    const std::vector<lab::Run> runs = place.measure("camera,right=0.1,frames=6",
        {"shadow_map:fit=uniform:map_size=128", "shadow_map:fit=cascades:map_size=128:stable_cascades=on",
            "shadow_map:fit=cascades:map_size=128:stable_cascades=off", "shadow_map:fit=focused:map_size=128"});
    const lab::Run &uniform = runs[0], &stable = runs[1], &tight = runs[2], &focused = runs[3];
    // uniform is the floor: its map does not move at all
    EXPECT_LT(change(stable), 2 * change(uniform));
    EXPECT_GT(tight.metrics.at("swimming"), 2 * stable.metrics.at("swimming"));
    EXPECT_GT(tight.metrics.at("flicker"), 2 * stable.metrics.at("flicker"));
    EXPECT_GT(focused.metrics.at("swimming"), 2 * stable.metrics.at("swimming"));
    EXPECT_EQ(stable.sequence.mae.size(), 6u);
    EXPECT_EQ(stable.sequence.change.size(), 5u);
    EXPECT_GT(stable.sequence.followed, stable.sequence.lost);
    EXPECT_EQ(stable.sequence.moved, 0u);
}

TEST_F(SequenceTest, AFitThatJumpsPops)
{
    // on the way ahead the warp of lispsm takes another turn between two frames; a map that does not move has nothing to jump
    Place place({.scene = "contact", .size = {128, 72}});
    const std::vector<lab::Run> runs
        = place.measure("camera,forward=0.15,frames=8", {"shadow_map:fit=uniform:map_size=256", "shadow_map:fit=lispsm:map_size=256"});
    EXPECT_GT(runs[1].metrics.at("popping"), 5 * runs[0].metrics.at("popping"));
    const std::vector<double>& change = runs[1].sequence.change;
    EXPECT_EQ(std::max_element(change.begin(), change.end()) - change.begin(), 3);
}

TEST_F(SequenceTest, SamplesThatTurnEveryFrameFlicker)
{
    Place place(contact);
    const std::vector<lab::Run> runs = place.measure(
        "still,frames=4", {"pcf:form=vogel:taps=8:rotation=blue_noise", "pcf:form=vogel:taps=8", "ray_traced", "virtual_shadow_map"});
    EXPECT_GT(runs[0].metrics.at("flicker"), 1e-4);
    for (size_t i = 1; i < runs.size(); ++i)
        for (const char* metric : {"flicker", "swimming", "popping"})
            EXPECT_EQ(runs[i].metrics.at(metric), 0.0) << runs[i].name << " " << metric;
}

TEST_F(SequenceTest, ExactTechniquesDoNotChange)
{
    Place place(contact);
    for (const char* motion : {"camera,right=0.05,turn=0.4,frames=4", "light,azimuth=1,frames=4"})
        for (const lab::Run& run : place.measure(motion, {"ray_traced", "shadow_volumes", "alias_free", "shadow_map"})) {
            SCOPED_TRACE(run.name + " " + motion);
            // single pixels at true edges may fall on the other side
            const double floor = run.technique == "shadow_map" ? 0.0 : 5e-4;
            for (const char* metric : {"flicker", "swimming", "popping"}) {
                if (floor > 0)
                    EXPECT_LT(run.metrics.at(metric), floor) << metric;
                else
                    EXPECT_GT(run.metrics.at(metric) + change(run), 5e-4) << metric;
            }
        }
}

TEST_F(SequenceTest, SoftLightsSayWhatTheTruthsNoiseAdds)
{
    Place place({.scene = "contact", .lights = {"sun,elevation=40,azimuth=120,angle=6"}, .size = {64, 36}});
    const std::vector<std::string> fixed = {"pcss:rotation=none"};
    const lab::Run few = place.measure("camera,frames=3", fixed, 16).front(), many = place.measure("camera,frames=3", fixed, 256).front();
    EXPECT_GT(many.metrics.at("temporal_noise"), 0.0);
    EXPECT_LT(many.metrics.at("temporal_noise"), 0.5 * few.metrics.at("temporal_noise"));
    EXPECT_LT(many.metrics.at("temporal_noise"), change(many));
    const lab::Run still = place.measure("still,frames=3", fixed).front();
    EXPECT_EQ(still.metrics.at("temporal_noise"), 0.0) << "one truth for all frames";
    EXPECT_EQ(change(still), 0.0);
    EXPECT_GT(change(place.measure("still,frames=3", {"pcss:rotation=blue_noise"}).front()), 0.0);
}

TEST_F(SequenceTest, LightsComeBackToTheirPlace)
{
    Place place({.scene = "contact", .lights = {"point,position=1/3/1"}, .size = {48, 27}});
    const lab::Run run = place.measure("light,x=0.05,frames=3", {"ray_traced"}).front();
    EXPECT_EQ(std::get<scene::PointLight>(place.stage.lights.front().shape).position, vec3(1, 3, 1));
    EXPECT_EQ(run.sequence.motion, "light,x=0.05,frames=3");
}

TEST_F(SequenceTest, AnAnimatedCasterIsLeftOutAndItsShadowIsNot)
{
    const char* shared = std::getenv("GNOMON_SHARED");
    const std::filesystem::path file
        = (shared ? std::filesystem::path(shared) : project_root() / "../shared") / "scenes" / "cesium_man.glb";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs cesium_man.glb in the folder of larger scenes (docs/testing.md)";
    Place place({.scene = file.string(), .lights = {"sun,elevation=45,azimuth=60"}, .size = {96, 96}});
    const std::vector<lab::Run> runs = place.measure("time,step=0.05,frames=5", {"shadow_map:map_size=256", "ray_traced"});
    for (const lab::Run& run : runs) EXPECT_GT(run.sequence.moved, 100u) << "the man's own surface";
    EXPECT_LT(change(runs[1]), 1e-3);
}

TEST_F(SequenceTest, MotionsThatDoNotSuitAreSentences)
{
    Place sunny(contact), lamp({.scene = "contact", .lights = {"point,position=1/3/1"}, .size = {16, 9}});
    const auto says = [](Place& place, const char* motion, const char* words) {
        try {
            place.measure(motion, {"ray_traced"});
            ADD_FAILURE() << motion;
        } catch (const base::Error& e) {
            EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
        }
    };
    says(lamp, "light,azimuth=1", "azimuth and elevation turn suns; this light is a point");
    says(sunny, "light,x=1", "this one is a sun, which turns");
    says(sunny, "time", "nothing of contact moves in that time");
    Place large({.scene = "plane", .size = {4096, 4096}});
    says(large, "camera,frames=8", "more than a sequence takes");
}

} // namespace
} // namespace gnomon::lab
