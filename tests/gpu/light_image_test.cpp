// SPDX-License-Identifier: Apache-2.0
// Techniques under a rectangular light with an image, on scenes of a few sheets, where each channel has a closed form.
#include "technique_fixture.h"

#include <cmath>

namespace gnomon {
namespace {

using gpu::camera_above;
using gpu::floor_scene;
using scene::LightImage;

struct Case {
    const char* technique;
    std::vector<std::pair<const char*, double>> values;
    double tolerance; ///< of a half plane's visibility
    double pattern; ///< of another turn of the samples against the map, where there is one
};

/// One sample more or less along an edge, of 16 or 8 samples that lie across it on each half; back_projection's patches add half a texel.
const std::vector<Case> cases = {
    {"light_sampling", {{"samples", 256}, {"map_size", 256}}, 2.5 / 16, 0},
    {"back_projection", {{"accumulate", 2}}, 0.02, 4.0 / 256},
    {"back_projection", {{"accumulate", 1}}, 0.04, 3.0 / 64},
    {"back_projection", {{"accumulate", 0}}, 0.02, 2e-5},
};

/// A quadrangle about `centre`.
void add_sheet(scene::Scene& s, vec3 centre, vec3 u, vec3 v)
{
    scene::Mesh mesh;
    mesh.positions = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(mesh);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(mesh);
}

/// Four metres above the origin, a metre wide, with half_u along x: what lies at x < 0 is the image's left side.
scene::Light overhead(const LightImage& image)
{
    scene::Light light = scene::parse_light("rect,position=0/4/0,target=0/0/0,width=1,height=1", {}, floor_scene(1).bounds());
    light.image = image;
    return light;
}

LightImage uniform_image(vec3 color) { return scene::make_light_image(2, 3, std::vector<vec3>(6, color), "uniform"); }

class LightImageTest : public gpu::TechniqueTest {
protected:
    static vec3 at(const Case& c, const scene::Scene& s, const scene::Camera& camera, const scene::Light& light)
    {
        const std::vector<float> out = draw(shadow::technique(c.technique), s, camera, {2, 2}, light, c.values);
        if (out.size() != 16) return vec3(-1);
        return vec3(out[0], out[1], out[2]);
    }
    static vec3 at_origin(const Case& c, const scene::Scene& s, const scene::Light& light)
    {
        return at(c, s, camera_above({0, 0, 0}, 0.05f, 1e-4f), light);
    }
};

TEST_F(LightImageTest, AUniformImageChangesNothing)
{
    scene::Scene s = floor_scene(4);
    gpu::add_quad(s, {-0.7f, 1, 0.2f}, 0.8f);
    for (const Case& c : cases) {
        SCOPED_TRACE(c.technique);
        const shadow::TechniqueInfo& info = shadow::technique(c.technique);
        const scene::Camera camera = camera_above({0, 0, 0}, 0.5f, 1.5f);
        const std::vector<float> grey = draw(info, s, camera, {32, 32}, overhead({}), c.values);
        const std::vector<float> colored = draw(info, s, camera, {32, 32}, overhead(uniform_image(vec3(3))), c.values);
        ASSERT_EQ(colored.size(), 4 * grey.size());
        int penumbra = 0;
        for (size_t i = 0; i < grey.size(); ++i) {
            penumbra += grey[i] > 0.01f && grey[i] < 0.99f;
            for (size_t k = 0; k < 3; ++k) ASSERT_NEAR(double(colored[4 * i + k]), double(grey[i]), c.pattern + 2e-6) << i;
        }
        EXPECT_GT(penumbra, 100);
    }
}

TEST_F(LightImageTest, AHalfPlaneHidesOneColourAfterTheOther)
{
    const scene::Light light = overhead(scene::load_light_image("halves"));
    for (const float edge : {-0.4f, -0.1f, 0.1f, 0.4f}) { // on the light: what lies left of it is hidden
        scene::Scene s = floor_scene(4);
        add_sheet(s, vec3(0.5f * (edge - 3), 2, 0), vec3(0.5f * (edge + 3), 0, 0), vec3(0, 0, 3));
        // the sheet halfway up ends at x = edge, which falls onto the light at 2 edge
        const double at = 2 * double(edge);
        const double red = std::clamp(-at / 0.5, 0.0, 1.0), blue = std::clamp((0.5 - at) / 0.5, 0.0, 1.0);
        for (const Case& c : cases) {
            SCOPED_TRACE(testing::Message() << c.technique << ", edge at " << at);
            const vec3 seen = at_origin(c, s, light);
            EXPECT_NEAR(seen.x, red, c.tolerance);
            EXPECT_NEAR(seen.z, blue, c.tolerance);
            EXPECT_NEAR(seen.y, std::clamp(0.5 - at, 0.0, 1.0), c.tolerance) << "no green light: the fraction of the area";
        }
    }
}

/// Whichever way the light is turned, and whichever of its sides the map calls x.
TEST_F(LightImageTest, EachHalfKeepsItsColour)
{
    // red at the left, and more green towards the top
    const LightImage image = scene::make_light_image(2, 2, {{1, 1, 0}, {0, 1, 1}, {1, 0, 0}, {0, 0, 1}}, "quarters");
    for (const vec3 down : {vec3(0, -1, 0), vec3(0, 1, 0), vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, -2, 0.5f)})
        for (const bool upright : {false, true}) {
            const mat3 axes = scene::basis_about(glm::normalize(down));
            const vec3 n = axes[2], a = upright ? axes[1] : axes[0], b = glm::cross(n, a);
            scene::Light light = overhead(image);
            light.shape = scene::RectLight{-4.0f * n, 0.5f * a, 0.5f * b};
            for (int half = 0; half < 4; ++half) { // hides where +-u or +-v is above 0
                scene::Scene s;
                s.materials.emplace_back();
                s.materials[0].double_sided = true;
                add_sheet(s, vec3(0), 4.0f * a, 4.0f * b);
                const vec3 towards = (half % 2 ? -1.0f : 1.0f) * (half < 2 ? a : b), along = half < 2 ? b : a;
                add_sheet(s, -2.0f * n + towards, 1.0f * towards, 3.0f * along);
                const scene::Camera camera{.eye = -0.05f * n, .target = vec3(0), .up = a, .half_height = 1e-4f};
                const vec3 expected[] = {{1, 0.5f, 0}, {0, 0.5f, 1}, {0.5f, 0, 0.5f}, {0.5f, 1, 0.5f}};
                for (Case c : {cases[2], cases[3]}) { // light_sampling has no axes of its own
                    c.values.emplace_back("map_size", 256);
                    SCOPED_TRACE(
                        testing::Message() << c.technique << ", " << down.x << "/" << down.y << "/" << down.z << ", half " << half);
                    const vec3 seen = at(c, s, camera, light);
                    for (int k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], expected[half][k], 0.08) << "channel " << k;
                }
            }
        }
}

TEST_F(LightImageTest, TheReceiversPlaneHidesItsPart)
{
    const scene::Light light = overhead(scene::load_light_image("halves"));
    for (const float x : {-0.2f, 0.0f, 0.3f}) {
        scene::Scene s = floor_scene(4);
        add_sheet(s, vec3(x, 1, 0), vec3(0, 0, 1), vec3(0, 1, 0)); // a wall, seen from x = -1: what lies beyond it is hidden
        const scene::Camera camera{.eye = vec3(-1, 1, 0), .target = vec3(0, 1, 0), .half_height = 1e-4f};
        for (const Case& c : cases) {
            SCOPED_TRACE(testing::Message() << c.technique << ", x = " << x);
            const vec3 seen = at(c, s, camera, light);
            EXPECT_NEAR(seen.x, std::min(1.0f, (x + 0.5f) / 0.5f), c.tolerance);
            EXPECT_NEAR(seen.z, std::max(0.0f, x / 0.5f), c.tolerance);
        }
    }
}

TEST_F(LightImageTest, OtherTechniquesTakeTheLightAsUniform)
{
    scene::Scene s = floor_scene(4);
    gpu::add_quad(s, {-0.7f, 1, 0.2f}, 0.8f);
    const shadow::TechniqueInfo& info = shadow::technique("pcss");
    ASSERT_FALSE(info.textured);
    const scene::Camera camera = camera_above({0, 0, 0}, 0.5f, 1.5f);
    EXPECT_EQ(
        draw(info, s, camera, {32, 32}, overhead({}), {}), draw(info, s, camera, {32, 32}, overhead(scene::load_light_image("glow")), {}));
}

} // namespace
} // namespace gnomon
