// SPDX-License-Identifier: Apache-2.0
// One suite over the whole registry: a new technique is tested with no test code. docs/testing.md says what each test asks.
#include "base/error.h"
#include "base/image_file.h"
#include "lab/folder.h"
#include "lab/render.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace gnomon {

namespace {

namespace fs = std::filesystem;

/// One device for the whole program, under the validation layers.
gpu::Device& device()
{
    const char* name = std::getenv("GNOMON_DEVICE");
    const char* validation = std::getenv("GNOMON_VALIDATION");
    static const std::unique_ptr<gpu::Device> shared = gpu::Device::open({name ? name : "", !validation || std::string(validation) != "0"});
    return *shared;
}

struct Case {
    const shadow::TechniqueInfo* info;
    std::string kind;
};

std::vector<Case> cases()
{
    std::vector<Case> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        for (const std::string& kind : lab::claimed_kinds(*info)) out.push_back({info, kind});
    return out;
}

std::string case_name(const testing::TestParamInfo<Case>& c) { return std::string(c.param.info->id) + "_" + c.param.kind; }

fs::path technique_folder(const shadow::TechniqueInfo& info) { return lab::project_root() / "techniques" / info.id; }

/// A light of each kind that shines on the origin from above.
std::string light_above(const std::string& kind)
{
    if (kind == "directional") return "sun,elevation=55,azimuth=30,angle=0";
    // a scene may have lights of these names: everything that matters is said
    if (kind == "spot") return "spot,position=2/5/1,target=0/0/0,cone=70,radius=0,intensity=40";
    if (kind == "point") return "point,position=2/5/1,radius=0,intensity=40";
    return kind + ",position=2/5/1,target=0/0/0,intensity=40";
}

class Conformance : public testing::TestWithParam<Case> {
protected:
    void SetUp() override
    {
        const std::string reason = GetParam().info->unavailable ? GetParam().info->unavailable(device()) : "";
        if (!reason.empty()) GTEST_SKIP() << GetParam().info->id << ": " << reason;
        errors_before_ = device().validation_errors().size();
    }
    void TearDown() override
    {
        for (size_t i = errors_before_; i < device().validation_errors().size(); ++i) ADD_FAILURE() << device().validation_errors()[i];
    }

    lab::Stage stage(const std::string& scene, base::Size size) const
    {
        return lab::open_stage({scene, {}, "", {light_above(GetParam().kind)}, size});
    }

    base::Picture draw(const lab::Stage& stage, const lab::Choice& choice) const
    {
        shadow::SceneGpu scene(device(), stage.scene);
        return lab::render(device(), scene, stage, choice, {.lit = false}).images.front();
    }
    lab::Choice defaults() const { return {GetParam().info, shadow::ParamValues(GetParam().info->params())}; }
    shadow::Output output() const { return lab::output_of(defaults()); }
    bool is_light_image() const { return output() == shadow::Output::visibility || output() == shadow::Output::transmittance; }

    size_t errors_before_ = 0;
};

/// The mean over the first `channels` channels of pixels on a surface.
double mean(const base::Picture& image, const lab::Stage& stage)
{
    const truth::Primary primary = truth::Tracer(stage.scene).primary(stage.view);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < image.size.area(); ++i) {
        if (primary.primitive[i] == truth::no_primitive) continue;
        sum += double(image.values[i * size_t(image.channels)]), ++count;
    }
    return count ? sum / double(count) : 0;
}

/// Pixels whose surroundings, `margin` pixels each way, are fully lit in truth: no shadow's edge is near.
std::vector<size_t> well_lit(const truth::Reference& truth, int margin)
{
    const base::Picture& mean = truth.visibility.mean;
    std::vector<size_t> out;
    for (int y = margin; y + margin < mean.size.height; ++y)
        for (int x = margin; x + margin < mean.size.width; ++x) {
            bool lit = true;
            for (int dy = -margin; dy <= margin; ++dy)
                for (int dx = -margin; dx <= margin; ++dx) {
                    const size_t i = size_t(y + dy) * size_t(mean.size.width) + size_t(x + dx);
                    lit = lit && mean.values[i] >= 1.0f && truth.primary.primitive[i] != truth::no_primitive;
                }
            if (lit) out.push_back(size_t(y) * size_t(mean.size.width) + size_t(x));
        }
    return out;
}

TEST_P(Conformance, what_nothing_stands_before_is_lit)
{
    if (!is_light_image()) GTEST_SKIP() << "not an image of one light";
    for (const char* scene : {"plane", "tilted_planes"}) {
        const lab::Stage s = stage(scene, {320, 180});
        const base::Picture image = draw(s, defaults());
        const truth::Reference truth = truth::reference(s.scene, s.view, s.lights.front(), {.samples = 64});
        const std::vector<size_t> lit = well_lit(truth, 3);
        ASSERT_GT(lit.size(), 1000u) << scene;
        size_t acne = 0;
        for (const size_t i : lit) acne += image.values[i * size_t(image.channels)] < 0.75f;
        EXPECT_LE(double(acne), 0.001 * double(lit.size())) << scene << ": " << acne << " of " << lit.size() << " lit pixels are dark";
    }
}

TEST_P(Conformance, a_closed_box_is_dark)
{
    if (!is_light_image()) GTEST_SKIP() << "not an image of one light";
    if (GetParam().info->partial) GTEST_SKIP() << "some things in the box, or the box, take no part";
    const lab::Stage s = stage("closed_box", {160, 90});
    EXPECT_LT(mean(draw(s, defaults()), s), 1e-3);
}

void expect_sane(const base::Picture& image, shadow::Output output, const std::string& what)
{
    const bool bounded = output == shadow::Output::visibility || output == shadow::Output::transmittance;
    size_t broken = 0;
    for (const float v : image.values) broken += !std::isfinite(v) || (bounded && (v < 0.0f || v > 1.0f));
    EXPECT_EQ(broken, 0u) << what;
}

TEST_P(Conformance, values_are_finite_and_repeat_bit_for_bit)
{
    const lab::Stage s = stage("contact", {160, 90});
    const base::Picture first = draw(s, defaults()), second = draw(s, defaults());
    expect_sane(first, output(), "contact");
    EXPECT_EQ(first.values, second.values);
}

TEST_P(Conformance, every_parameter_runs_at_both_ends)
{
    const lab::Stage s = stage("contact", {64, 48});
    shadow::SceneGpu scene(device(), s.scene);
    const shadow::ParamValues values(GetParam().info->params());
    for (const shadow::ParamInfo& p : values.table().fields)
        for (const double end : {p.range.min, p.range.max}) {
            lab::Choice choice = defaults();
            choice.params.set(p.name, end);
            const std::string what = p.name + " = " + choice.params.text(p);
            SCOPED_TRACE(what);
            expect_sane(lab::render(device(), scene, s, choice, {.lit = false}).images.front(), lab::output_of(choice), what);
        }
}

TEST_P(Conformance, odd_sizes_work)
{
    for (const base::Size size : {base::Size{1, 1}, base::Size{257, 129}}) {
        const lab::Stage s = stage("balls", size);
        expect_sane(draw(s, defaults()), output(), std::to_string(size.width));
    }
}

TEST_P(Conformance, lit_picture_is_composited)
{
    const lab::Stage s = stage("balls", {96, 64});
    shadow::SceneGpu scene(device(), s.scene);
    const base::Picture radiance = lab::render(device(), scene, s, defaults(), {}).radiance;
    for (const float v : radiance.values) ASSERT_TRUE(std::isfinite(v) && v >= 0.0f);
}

TEST_P(Conformance, golden)
{
    const std::string skip = lab::golden_skip(device());
    if (!skip.empty()) GTEST_SKIP() << skip;
    const fs::path file = technique_folder(*GetParam().info) / ("golden." + GetParam().kind + ".png");
    ASSERT_TRUE(fs::exists(file)) << file << " is missing; look at the picture, then `gnomon bless " << GetParam().info->id
                                  << " --because ...`";
    const lab::TechniqueScene own = lab::read_technique_scene(technique_folder(*GetParam().info));
    const base::Picture got = lab::golden_image(device(), *GetParam().info, GetParam().kind, technique_folder(*GetParam().info));
    const lab::GoldenDifference d
        = lab::compare_golden(got, base::read_png(file, base::Encoding::linear), own.golden_pixels, own.golden_mean);
    if (d.same) return;
    const fs::path folder = fs::path("golden-failures");
    base::write_png(folder / (case_name({GetParam(), 0}) + ".png"), got, base::Encoding::linear);
    ADD_FAILURE() << file << "\n" << d.text << "\nthe picture made is in " << fs::absolute(folder);
}

INSTANTIATE_TEST_SUITE_P(Techniques, Conformance, testing::ValuesIn(cases()), case_name);

class Promise : public testing::TestWithParam<const shadow::TechniqueInfo*> { };

TEST_P(Promise, holds_against_truth)
{
    const shadow::TechniqueInfo& info = *GetParam();
    const std::string reason = info.unavailable ? info.unavailable(device()) : "";
    if (!reason.empty()) GTEST_SKIP() << info.id << ": " << reason;
    const size_t before = device().validation_errors().size();
    const lab::PromiseReport report = lab::check_promises(device(), info, technique_folder(info));
    for (const lab::BrokenPromise& b : report.broken)
        ADD_FAILURE() << info.id << " under a " << b.kind << " light: " << b.metric << " is " << b.measured << ", promised at most "
                      << b.bound;
    for (const lab::Run& run : report.runs)
        for (const auto& [metric, value] : run.metrics) RecordProperty(run.light + "." + metric, std::to_string(value));
    EXPECT_EQ(device().validation_errors().size(), before);
}

/// Opaque scenes: the built-in ones, and the shared ones where they are.
std::vector<std::string> opaque_scenes()
{
    std::vector<std::string> out;
    for (const scene::Builtin& b : scene::builtins())
        if (b.opaque) out.emplace_back(b.name);
    const char* shared = std::getenv("GNOMON_SHARED");
    const fs::path folder = fs::path(shared ? shared : lab::project_root() / ".." / "shared") / "scenes";
    for (const char* name : {"shadow_columns.glb", "stanford_group.glb", "cesium_man.glb"})
        if (fs::exists(folder / name)) out.push_back((folder / name).string());
    return out;
}

TEST_P(Promise, exact_methods_are_right_outside_the_band)
{
    const shadow::TechniqueInfo& info = *GetParam();
    const std::string reason = info.unavailable ? info.unavailable(device()) : "";
    if (!reason.empty()) GTEST_SKIP() << info.id << ": " << reason;
    if (!info.exact || shadow::output(info, shadow::ParamValues(info.params()).bytes()) != shadow::Output::visibility)
        GTEST_SKIP() << info.id << " is not an exact method for visibility";
    for (const std::string& name : opaque_scenes()) {
        const lab::Stage s = lab::open_stage({name, {}, "", {"directional,elevation=40,azimuth=120,angle=0"}, {240, 180}});
        shadow::SceneGpu scene(device(), s.scene);
        const truth::Reference truth = truth::reference(s.scene, s.view, s.lights.front(), {.samples = 1});
        const lab::Rendered rendered
            = lab::render(device(), scene, s, {&info, shadow::ParamValues(info.params())}, {.lit = false, .aovs = lab::scored_aovs});
        lab::Run run;
        lab::score(s, s.lights.front(), truth, rendered, run);
        EXPECT_EQ(run.metrics.at("wrong_outside_band"), 0.0) << name;
        EXPECT_LT(double(run.excluded_pixels), 0.01 * double(run.scored_pixels + run.excluded_pixels)) << name;
    }
}

TEST_P(Promise, refuses_lights_it_does_not_claim)
{
    for (int k = 0; k < scene::light_kind_count; ++k) {
        scene::Light light;
        const scene::LightShape shapes[]
            = {scene::DirectionalLight{}, scene::SpotLight{}, scene::PointLight{}, scene::RectLight{}, scene::DiskLight{}};
        light.shape = shapes[k];
        if (GetParam()->lights & (1u << k)) continue;
        EXPECT_NE(shadow::refusal(*GetParam(), device(), light).find(GetParam()->id), std::string::npos);
    }
}

TEST_P(Promise, page_has_its_headings)
{
    const fs::path folder = technique_folder(*GetParam());
    std::ifstream file(folder / "README.md");
    const std::string page((std::istreambuf_iterator<char>(file)), {});
    for (const char* heading : {"## In one sentence", "## Picture", "## How it works", "## Parameters", "## What it costs",
             "## How wrong it is", "## Where it fails", "## Differs from the paper", "## References"})
        EXPECT_NE(page.find(heading), std::string::npos) << folder << " lacks " << heading;
}

std::string technique_name(const testing::TestParamInfo<const shadow::TechniqueInfo*>& p) { return std::string(p.param->id); }
INSTANTIATE_TEST_SUITE_P(Techniques, Promise, testing::ValuesIn(shadow::techniques().begin(), shadow::techniques().end()), technique_name);

TEST(Docs, generated_blocks_are_current)
{
    for (const fs::path& file : lab::update_docs(lab::project_root(), true)) ADD_FAILURE() << file << " is stale; run `gnomon docs`";
}

} // namespace

} // namespace gnomon
