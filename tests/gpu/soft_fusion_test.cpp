// SPDX-License-Identifier: Apache-2.0
// Two blockers that hide 30 % and 70 % of a light, side by side, overlapping and one within the other: in truth 100, 90 and 70 % are
// hidden. Methods that sample the light's points get that; those that find one depth for all blockers give a wrong value, which follows
// from their definition.
#include "soft_fixture.h"

extern const gnomon::shadow::TechniqueInfo technique_back_projection, technique_cssm, technique_light_sampling, technique_moment_soft,
    technique_occlusion_textures, technique_pcss, technique_vssm;

namespace gnomon {
namespace {

using gpu::camera_above;
using gpu::floor_scene;

/// Tangents of directions from the light's centre.
struct Rect {
    vec2 lo, hi;
    float depth;
    double area() const { return overlap(*this); }
    double overlap(const Rect& o) const
    {
        const vec2 size = glm::max(glm::min(hi, o.hi) - glm::max(lo, o.lo), vec2(0));
        return double(size.x) * double(size.y);
    }
};

constexpr float light_height = 4;
constexpr const char* square_light = "rect,position=0/4/0,target=0/0/0,width=1,height=1";

/// What hides the part from lo to hi of the light, in metres about its centre, from the origin.
Rect blocker(float height, vec2 lo, vec2 hi)
{
    const float scale = height / light_height / (light_height - height);
    return {lo * scale, hi * scale, light_height - height};
}

/// Half the window of blockers at `depth`.
float half_window(float depth) { return 0.5f * (light_height - depth) / (depth * light_height); }

Rect window(float half) { return {vec2(-half), vec2(half), 0}; }

/// Percentage-closer soft shadows over continuous depths, blockers not hiding one another (Fernando 2005): mean depth in the window of the
/// nearest, then the blocked part of the window of that depth.
double percentage_closer(const Rect& a, const Rect& b)
{
    const Rect search = window(half_window(std::min(a.depth, b.depth)));
    const double in_a = a.overlap(search), in_b = b.overlap(search);
    const float mean = float((in_a * double(a.depth) + in_b * double(b.depth)) / (in_a + in_b));
    const Rect filter = window(half_window(mean));
    return 1.0 - (a.overlap(filter) + b.overlap(filter)) / filter.area();
}

class SoftFusion : public gpu::TechniqueTest {
protected:
    struct Arrangement {
        Rect upper, lower;
        double hidden;
    };
    static std::vector<Arrangement> arrangements()
    {
        std::vector<Arrangement> out;
        for (const auto& [begin, hidden] : {std::pair(-0.2f, 1.0), std::pair(-0.3f, 0.9), std::pair(-0.5f, 0.7)})
            out.push_back({blocker(1.5f, {-0.5f, -0.5f}, {-0.2f, 0.5f}), blocker(0.7f, {begin, -0.5f}, {begin + 0.7f, 0.5f}), hidden});
        return out;
    }
    static double visible(const shadow::TechniqueInfo& info, const Arrangement& a, const Values& values)
    {
        scene::Scene s = floor_scene(4);
        for (const Rect& r : {a.upper, a.lower}) gpu::add_sheet(s, light_height - r.depth, r.lo * r.depth, r.hi * r.depth);
        return mean(draw(info, s, camera_above(vec3(0), 0.05f, 1e-4f), {2, 2}, square_light, values));
    }
};

TEST_F(SoftFusion, SamplesOfTheLightAreRight)
{
    for (const Arrangement& a : arrangements()) {
        EXPECT_NEAR(visible(technique_light_sampling, a, {{"samples", 256}}), 1 - a.hidden, 0.02) << a.hidden;
        EXPECT_NEAR(visible(technique_back_projection, a, {}), 1 - a.hidden, 0.06) << a.hidden; // half a texel of either at each edge
    }
}

TEST_F(SoftFusion, OneDepthForAllBlockersGivesThePredictedWrongValue)
{
    for (const Arrangement& a : arrangements()) {
        const double predicted = percentage_closer(a.upper, a.lower);
        EXPECT_GT(std::abs(predicted - (1 - a.hidden)), 0.02) << "not wrong";
        EXPECT_NEAR(visible(technique_pcss, a, {{"pattern", 0}, {"centred", 0}, {"map_size", 2048}, {"cap", 1024}}), predicted, 0.02)
            << a.hidden;
        const Values moments = {{"map_size", 2048}, {"widest", 0.25}, {"centred", 0}};
        EXPECT_NEAR(visible(technique_vssm, a, moments), predicted, 0.05) << a.hidden;
        EXPECT_NEAR(visible(technique_moment_soft, a, moments), predicted, 0.05) << a.hidden;
        EXPECT_NEAR(visible(technique_cssm, a, {{"map_size", 1024}, {"widest", 0.25}, {"terms", 8}, {"iterations", 0}}), predicted, 0.05)
            << a.hidden;
    }
}

// One after another, as if neither knew of the other: 0.3 of 0.7 is left however they lie.
TEST_F(SoftFusion, SlicesMultiply)
{
    for (const Arrangement& a : arrangements())
        EXPECT_NEAR(visible(technique_occlusion_textures, a, {{"map_size", 2048}, {"fusion", 0}}), 0.7 * 0.3, 0.05) << a.hidden;
}

} // namespace
} // namespace gnomon
