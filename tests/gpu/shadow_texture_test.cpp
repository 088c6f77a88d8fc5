// SPDX-License-Identifier: Apache-2.0
// Shadow textures on scenes of a few quads: who casts, who receives, what lies outside of the texture, blur and cookies.
#include "technique_fixture.h"

#include "techniques/shadow_texture/caster_bits.h"

#include <algorithm>
#include <cmath>
#include <set>

extern const gnomon::shadow::TechniqueInfo technique_shadow_texture;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;

class ShadowTexture : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(const scene::Scene& s, const scene::Camera& camera, const char* light, const Values& values = {})
    {
        return TechniqueTest::draw(technique_shadow_texture, s, camera, {64, 64}, light, values);
    }
    static size_t dark(const std::vector<float>& v)
    {
        return size_t(std::count_if(v.begin(), v.end(), [](float x) { return x < 0.5f; }));
    }
};

/// Sees the floor alone, from just above it, 4 metres each way.
scene::Camera low_camera() { return camera_above({0, 0, 0}, 0.1f, 4); }

scene::Scene one_caster()
{
    scene::Scene s = floor_scene(8);
    add_quad(s, {1, 1, 0.5f}, 0.5f);
    return s;
}

TEST_F(ShadowTexture, SmallInstancesCastAndLargeOnesReceive)
{
    const scene::Scene s = one_caster();
    EXPECT_EQ(techniques::shadow_texture::caster_bits(s, 0.35f), std::vector<uint32_t>{0b1100});
    EXPECT_EQ(techniques::shadow_texture::caster_bits(s, 0.01f), std::vector<uint32_t>{0});
    EXPECT_EQ(techniques::shadow_texture::caster_bits(s, 1.0f), std::vector<uint32_t>{0b1111});
    EXPECT_EQ(techniques::shadow_texture::caster_bits({}, 1.0f).size(), 1u);
    EXPECT_EQ(dark(draw(s, low_camera(), "sun,elevation=45,azimuth=90,angle=0", {{"largest_caster", 0.01}})), 0u);
}

TEST_F(ShadowTexture, ShadowLiesWhereTheRaysSayToATexel)
{
    const struct {
        const char* light;
        float x0, x1, z0, z1;
    } cases[] = {{"sun,elevation=45,azimuth=90,angle=0", -0.5f, 0.5f, 0, 1}, {"point,position=0/3/0,radius=0", 0.75f, 2.25f, 0, 1.5f},
        {"spot,position=0/3/0,target=0.5/0/0.5,cone=110,radius=0", 0.75f, 2.25f, 0, 1.5f}};
    for (const auto& c : cases) {
        const std::vector<float> v = draw(one_caster(), low_camera(), c.light);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const float px = (float(x) + 0.5f) / 8 - 4, pz = (float(y) + 0.5f) / 8 - 4;
                if (c.light[1] == 'p' && std::hypot(px - 0.5f, pz - 0.5f) > 2.5f) continue; // the spot's cone
                // of one metre from the edges; texels are 1 to 2 cm
                const float in = std::min({px - c.x0, c.x1 - px, pz - c.z0, c.z1 - pz});
                if (std::abs(in) <= 0.03f) continue;
                ASSERT_EQ(v[size_t(y * 64 + x)], in > 0 ? 0.0f : 1.0f) << c.light << " at " << px << " " << pz;
            }
    }
}

TEST_F(ShadowTexture, CastersReceiveOnlyWhereAskedAndThenShadowThemselves)
{
    const scene::Camera above = camera_above({1, 0, 0.5f}, 3, 0.4f); // sees the caster's upper side alone
    const char* light = "sun,elevation=45,azimuth=90,angle=0";
    EXPECT_EQ(dark(draw(one_caster(), above, light)), 0u);
    EXPECT_EQ(dark(draw(one_caster(), above, light, {{"receivers", 1}})), 64u * 64u);
}

TEST_F(ShadowTexture, NothingIsShadowedBehindTheLight)
{
    scene::Scene s = floor_scene(8);
    add_quad(s, {0, 6, 0}, 8); // a ceiling
    add_quad(s, {0.5f, 1, 0}, 0.3f); // below the light
    const scene::Camera up{.eye = {0, 5.8f, 0}, .target = {0, 10, 0}, .up = {0, 0, -1}, .half_height = 4};
    const char* light = "point,position=0/3/0,radius=0";
    EXPECT_EQ(dark(draw(s, up, light)), 0u);
    EXPECT_GT(dark(draw(s, low_camera(), light)), 20u);
    scene::Scene past = floor_scene(8);
    add_quad(past, {0.5f, 4, 0}, 0.3f); // above the light
    EXPECT_EQ(dark(draw(past, low_camera(), light)), 0u);
}

TEST_F(ShadowTexture, TheTexturesBorderIsLit)
{
    for (const double blur : {1.0, 65.0})
        for (const char* light : {"sun,elevation=30,azimuth=20,angle=0", "point,position=0/1/0,radius=0"}) {
            const std::vector<float> v
                = draw(floor_scene(8), camera_above({0, 0, 0}, 0.5f, 10), light, {{"blur", blur}, {"texture_size", 64}});
            EXPECT_EQ(*std::min_element(v.begin(), v.end()), 1.0f) << light << " " << blur;
        }
    // a texel is not stretched over what lies beside the texture: the caster touches the rim of what the view sees
    scene::Scene s = floor_scene(8);
    add_quad(s, {4, 1, 0}, 0.5f);
    const std::vector<float> v = draw(s, low_camera(), "sun,elevation=90,angle=0");
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const float px = (float(x) + 0.5f) / 8 - 4, pz = (float(y) + 0.5f) / 8 - 4;
            ASSERT_EQ(v[size_t(y * 64 + x)]<0.5f, px> 3.5f && std::abs(pz) < 0.5f) << px << " " << pz;
        }
}

TEST_F(ShadowTexture, BlurIsSymmetricAboutTheEdge)
{
    scene::Scene s = floor_scene(8);
    for (int i = 0; i < 8; ++i) add_quad(s, {-1, 1, float(i) - 3.5f}, 1); // x from -2 to 0
    const std::vector<float> v
        = draw(s, camera_above({0, 0, 0}, 0.1f, 1), "sun,elevation=90,angle=0", {{"blur", 31}, {"texture_size", 128}});
    size_t between = 0;
    for (size_t x = 0; x < 32; ++x) {
        const float left = v[32 * 64 + x], right = v[32 * 64 + 63 - x];
        EXPECT_NEAR(left + right, 1.0f, 0.06f) << x;
        EXPECT_LE(v[32 * 64 + x], v[32 * 64 + x + 1] + 0.01f);
        between += left > 0.05f && left < 0.95f;
    }
    EXPECT_GT(between, 3u);
    EXPECT_LT(v[32 * 64], 0.1f);
}

TEST_F(ShadowTexture, CookiesFillASpotsConeAndTurn)
{
    const char* spot = "spot,position=0/4/0,target=0/0/0,cone=80,radius=0";
    const scene::Camera camera = camera_above({0, 0, 0}, 0.1f, 2);
    const auto values = [&](double cookie, double turn) {
        return TechniqueTest::draw(
            technique_shadow_texture, floor_scene(8), camera, {64, 64}, spot, {{"cookie", cookie}, {"cookie_turn", turn}});
    };
    const std::vector<float> none = values(0, 0), halves = values(1, 0), window = values(2, 0), glow = values(3, 0);
    EXPECT_EQ(*std::min_element(none.begin(), none.end()), 1.0f);
    EXPECT_EQ(std::set<float>(halves.begin(), halves.end()).size(), 2u); // red and blue
    EXPECT_NEAR(mean(halves), 0.5 * (1 + 0.0722 / 0.2126), 0.02);
    EXPECT_EQ(*std::min_element(window.begin(), window.end()), 0.0f); // bars
    EXPECT_GT(mean(window), 0.2);
    EXPECT_GT(std::set<float>(glow.begin(), glow.end()).size(), 100u);
    EXPECT_EQ(values(2, 90), window) << "frame 0 is not turned";
    // other lights have none
    EXPECT_EQ(dark(draw(floor_scene(8), camera, "sun,elevation=60,angle=0", {{"cookie", 2}})), 0u);
}

} // namespace
} // namespace gnomon
