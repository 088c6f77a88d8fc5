// SPDX-License-Identifier: Apache-2.0
// per_triangle_volumes against its twin: the tree must find what a test of every sample finds, and the device what the CPU does.
#include "exact_suite.h"
#include "per_triangle_twin.h"

extern const gnomon::shadow::TechniqueInfo technique_per_triangle_volumes;

namespace gnomon {
namespace {

class PerTriangleTwin : public ExactTest {
protected:
    /// Returns how many of the compared pixels are dark by a volume.
    static size_t expect_equal(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const std::string& text)
    {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const scene::View view = scene::make_view(camera, size, s.bounds());
        const Surface drawn = surface(s, view);
        per_triangle_twin::Twin twin(s, view, light);
        const std::vector<uint8_t> by_tree = twin.by_tree(drawn.depth, drawn.primitive);
        const std::vector<uint8_t> one_by_one = twin.one_by_one(drawn.depth, drawn.primitive);
        EXPECT_LT(twin.tests(), twin.volume_count() * (size_t(size.area()) / 2 + 64));

        const HardTruth truth(s, light);
        const std::vector<Seen> seen = receivers(truth, s, camera, size);
        const std::vector<float> got = draw({technique_per_triangle_volumes, "", {}}, s, camera, size, text);
        size_t differ = 0, differ_on_device = 0, compared = 0, dark = 0;
        for (size_t i = 0; i < got.size(); ++i) {
            const double facing = seen[i].own == SIZE_MAX ? 0 : glm::dot(seen[i].n, glm::normalize(truth.to_light(seen[i].p)));
            // The G-buffer's normals are rounded: what faces the light edge-on may count as turned away.
            if (!(facing > 1e-3)) continue;
            differ += by_tree[i] != one_by_one[i];
            differ_on_device += got[i] != (by_tree[i] ? 0.0f : 1.0f);
            dark += by_tree[i];
            ++compared;
        }
        EXPECT_EQ(differ, 0u) << "the tree";
        EXPECT_EQ(differ_on_device, 0u) << text << ", " << size.width << " x " << size.height << " (" << compared << " pixels)";
        EXPECT_GT(compared, 0u);
        return dark;
    }
};

TEST_F(PerTriangleTwin, TheSameBitsForRandomTriangles)
{
    const char* lights[] = {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/2.5/1,radius=0", "point,position=-1/9/2,radius=0",
        "sun,elevation=12,azimuth=200,angle=0"};
    const scene::Camera plan{.eye = {1, 7, 2}, .target = {0, 0.5f, 0}, .half_height = 3};
    for (uint32_t seed = 300; seed < 312; ++seed)
        EXPECT_GT(expect_equal(soup(seed, 30 + int(seed % 4) * 40), seed % 3 ? oblique : plan, {64, 48}, lights[seed % 4]), 10u);
}

TEST_F(PerTriangleTwin, TheSameBitsForPicturesOfAllSizes)
{
    const scene::Scene s = soup(77, 120);
    const scene::Camera near{.eye = {1.5f, 2, 2.5f}, .target = {0, 0.2f, 0}};
    for (const gpu::Size size : {gpu::Size{1, 1}, gpu::Size{8, 4}, gpu::Size{9, 5}, gpu::Size{32, 32}, gpu::Size{33, 31},
             gpu::Size{257, 129}, gpu::Size{256, 128}, gpu::Size{1, 300}, gpu::Size{500, 2}})
        expect_equal(s, near, size, "point,position=0.5/3.5/0.3,radius=0");
}

} // namespace
} // namespace gnomon
