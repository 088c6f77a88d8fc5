// SPDX-License-Identifier: Apache-2.0
// Every pixel against a test of every triangle in double precision: soups, meshes that are no surfaces, lights and eyes in odd places.
#include "alias_free_truth.h"

extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;

namespace gnomon {
namespace {

using gpu::camera_above;
using gpu::floor_scene;

constexpr double closed = 0, bergeron = 1, any = 2;
constexpr double zpass = 0, zfail = 1, zp_plus = 2, pp_zp = 3;

struct Count {
    size_t wrong = 0, unknown = 0, dark = 0, lit = 0;
};

class ShadowVolumes : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(
        const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values)
    {
        return TechniqueTest::draw(technique_shadow_volumes, s, camera, size, light, values);
    }

    /// The primitive of each pixel.
    static std::vector<float> primitives(const scene::Scene& s, const scene::View& view)
    {
        shadow::SceneGpu scene(device(), s);
        gpu::Image out = image("primitive", VK_FORMAT_R32_UINT, view.size);
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        passes.copy(g.primitive, passes.import(out));
        device().submit(std::move(passes));
        return device().read_back(out).values;
    }

    static Count compare(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* text, const Values& values)
    {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const HardTruth truth(s, light);
        const scene::View view = scene::make_view(camera, size, s.bounds());
        const std::vector<float> seen = primitives(s, view), got = draw(s, camera, size, text, values);
        Count count;
        for (size_t i = 0; i < got.size(); ++i) {
            if (seen[i] >= 4294967040.0f) {
                count.wrong += got[i] != 1.0f;
                continue;
            }
            const size_t own = size_t(seen[i]);
            const scene::Ray ray = scene::view_ray(view, vec2(float(i % size_t(size.width)) + 0.5f, float(i / size_t(size.width)) + 0.5f));
            dvec3 n = glm::normalize(HardTruth::normal(truth.triangles()[own]));
            const double facing = glm::dot(n, dvec3(ray.direction));
            if (std::abs(facing) < 0.05) {
                ++count.unknown;
                continue;
            }
            if (facing > 0) n = -n;
            const double along = glm::dot(n, truth.triangles()[own][0] - dvec3(ray.origin)) / glm::dot(n, dvec3(ray.direction));
            const Verdict verdict = truth.at(dvec3(ray.origin) + along * dvec3(ray.direction), n, own);
            count.unknown += verdict == Verdict::unknown;
            count.dark += verdict == Verdict::dark;
            count.lit += verdict == Verdict::lit;
            count.wrong += (verdict == Verdict::dark && got[i] != 0.0f) || (verdict == Verdict::lit && got[i] != 1.0f);
        }
        return count;
    }
    /// No pixel wrong, and enough of them known.
    static void expect_right(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values,
        size_t least_dark = 100, size_t least_lit = 100, double most_unknown = 0.04)
    {
        const Count c = compare(s, camera, size, light, values);
        EXPECT_EQ(c.wrong, 0u) << light << " of " << size.area();
        EXPECT_LT(double(c.unknown), most_unknown * double(size.area())) << light;
        EXPECT_GE(c.dark, least_dark) << light;
        EXPECT_GE(c.lit, least_lit) << light;
    }

    inline static const scene::Camera oblique{.eye = {4, 4, 6}, .target = {0, 0.5f, 0}};
};

TEST_F(ShadowVolumes, RandomTrianglesHaveNoWrongPixel)
{
    const char* lights[] = {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/2.5/1,radius=0",
        "spot,position=5/6/2,target=0/0/0,cone=50,radius=0", "sun,elevation=12,azimuth=200,angle=0", "point,position=-1/9/2,radius=0"};
    for (uint32_t seed = 0; seed < 60; ++seed) {
        const scene::Scene s = soup(seed, 40 + int(seed % 3) * 60);
        expect_right(s, oblique, {64, 48}, lights[seed % 5], {{"count", zfail}}, 20, 20);
        
        
    }
}

TEST_F(ShadowVolumes, LightsInExtremePlacesAreExact)
{
    const scene::Scene s = soup(7, 100);
    for (const char* light : {"point,position=0/0.7/0,radius=0", // among the triangles, in the frustum
             "point,position=4/4/6,radius=0", // at the eye
             "point,position=4.3/5/5,radius=0", // beside it, in the picture's plane
             "point,position=0/0.001/0,radius=0", // a millimetre above the floor
             "sun,direction=-4/-3.5/-6,angle=0", // down the view's axis
             "spot,position=8/7.5/12,target=0/0.5/0,cone=40,radius=0", // the same
             "sun,direction=4/-0.5/6,angle=0", // towards the eye
             "sun,elevation=90,angle=0", "sun,elevation=0.5,azimuth=30,angle=0"})
        for (const double count : {zfail, pp_zp, zp_plus}) {
            SCOPED_TRACE(count);
            expect_right(s, oblique, {96, 64}, light, {{"count", count}}, 0, 0, 0.5);
        }
}

} // namespace
} // namespace gnomon
