// SPDX-License-Identifier: Apache-2.0
// Per-triangle volumes under the suite of exact techniques, and what must not change a bit of them: how teams exchange bits, the room in
// their list, the order in which triangles come, which of them come first, and those that closed shapes can do without.
#include "exact_suite.h"

#include "techniques/per_triangle_volumes/depth_tree.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

extern const gnomon::shadow::TechniqueInfo technique_per_triangle_volumes;

namespace gnomon {
namespace {

const ExactSubject plain{technique_per_triangle_volumes, "plain", {}, 0, 200};
const ExactSubject shared_memory{technique_per_triangle_volumes, "shared_memory", {{"team", 1}}, 50, 10};
const ExactSubject blockers{technique_per_triangle_volumes, "blockers", {{"blockers", 1}, {"blocker_size", 0.01}, {"queue", 7}}, 60, 10};
INSTANTIATE_TEST_SUITE_P(per_triangle_volumes, ExactSoups, testing::Values(plain, shared_memory, blockers), exact_name);
INSTANTIATE_TEST_SUITE_P(per_triangle_volumes, ExactPlaces, testing::Values(plain, shared_memory, blockers), exact_name);
INSTANTIATE_TEST_SUITE_P(per_triangle_volumes, ExactBadInput, testing::Values(plain, shared_memory, blockers), exact_name);

class PerTriangleVolumes : public ExactTest {
protected:
    using Values = std::vector<std::pair<const char*, double>>;
    static std::vector<float> draw(
        const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const std::string& light, const Values& values = {})
    {
        return ExactTest::draw({technique_per_triangle_volumes, "", values}, s, camera, size, light);
    }
    inline static const std::array<std::string, 3> lights{
        "sun,elevation=40,azimuth=60,angle=0", "point,position=0.5/2.5/0.3,radius=0", "spot,position=4/5/1,target=0/0/0,cone=60,radius=0"};
};

TEST_F(PerTriangleVolumes, HowTheWorkIsSharedOutDoesNotChangeABit)
{
    const scene::Scene s = soup(31, 200);
    const Values ways[] = {{{"team", 1}}, {{"queue", 0}}, {{"queue", 100}}, {{"team", 1}, {"queue", 3}},
        {{"blockers", 1}, {"blocker_size", 0}}, {{"blockers", 1}, {"blocker_size", 0.02}}, {{"blockers", 1}, {"blocker_size", 1}}};
    for (const std::string& light : lights)
        for (const gpu::Size size : {gpu::Size{1, 1}, gpu::Size{97, 61}, gpu::Size{300, 33}}) {
            const std::vector<float> first = draw(s, oblique, size, light);
            for (const Values& way : ways)
                EXPECT_EQ(first, draw(s, oblique, size, light, way)) << light << " " << way[0].first << " " << size.width;
        }
}

/// The same triangles in another order, each from another of its corners on, some of them turned over.
scene::Scene shuffled(scene::Scene s, uint32_t seed)
{
    std::mt19937 random(seed);
    for (scene::Mesh& m : s.meshes) {
        std::vector<size_t> order(m.triangle_count());
        std::iota(order.begin(), order.end(), 0);
        for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
        std::vector<uint32_t> indices;
        for (const size_t t : order) {
            std::array<uint32_t, 3> corners{m.indices[3 * t], m.indices[3 * t + 1], m.indices[3 * t + 2]};
            std::rotate(corners.begin(), corners.begin() + random() % 3, corners.end());
            if (random() % 2) std::swap(corners[0], corners[1]);
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
        m.indices = indices;
    }
    return s;
}

/// Over a floor that stays as it is: receivers that are drawn from another corner on may get other depths.
TEST_F(PerTriangleVolumes, TheOrderOfTrianglesAndCornersDoesNotChangeABit)
{
    scene::Scene s = soup(32, 150);
    for (vec3& p : s.meshes[1].positions) p.y += 7;
    const scene::Camera below{.eye = {3, 3, 5}, .target = {0, 0, 0}};
    const gpu::Size size{128, 96};
    for (const std::string& light :
        {std::string("sun,elevation=70,azimuth=60,angle=0"), std::string("point,position=0.5/14/0.3,radius=0")}) {
        const std::vector<float> first = draw(s, below, size, light);
        EXPECT_GT(std::count(first.begin(), first.end(), 0.0f), 300);
        for (uint32_t seed = 0; seed < 4; ++seed) {
            scene::Scene other = s;
            const scene::Scene turned = shuffled(s, seed);
            other.meshes[1] = turned.meshes[1];
            EXPECT_EQ(first, draw(other, below, size, light)) << seed;
        }
    }
}

/// Closed and single-sided: one side of it will do.
TEST_F(PerTriangleVolumes, EitherSideOfAClosedShapeCastsItsShadow)
{
    scene::Scene s = floor_scene(4);
    s.materials.emplace_back();
    for (uint32_t k = 0; k < 3; ++k)
        for (scene::Mesh& m : closed_shape(k)) {
            m.material = 1;
            add_mesh(s, std::move(m), glm::translate(mat4(1), vec3(2.2f * float(k) - 2.2f, 4.5f, 0.3f * float(k))));
        }
    // the floor alone is seen
    const scene::Camera low{.eye = {0, 2.5f, 6}, .target = {0, 0, 0.5f}, .fov_y = 0.6f};
    for (const std::string& light :
        {std::string("sun,elevation=60,azimuth=30,angle=0"), std::string("point,position=0.5/9/0.3,radius=0")}) {
        const gpu::Size size{160, 120};
        const std::vector<float> both = draw(s, low, size, light);
        EXPECT_GT(std::count(both.begin(), both.end(), 0.0f), 500);
        for (const double cull : {1.0, 2.0}) {
            const std::vector<float> one = draw(s, low, size, light, {{"cull", cull}});
            size_t differ = 0;
            for (size_t i = 0; i < both.size(); ++i) differ += both[i] != one[i];
            EXPECT_EQ(differ, 0u) << light << ", cull " << cull;
        }
    }
}

TEST_F(PerTriangleVolumes, BlocksOutOfReachAreLeftOutAndCounted)
{
    // shadows that fall beside and behind what is seen
    scene::Scene s = floor_scene(4);
    for (int k = 0; k < 20; ++k) {
        auto shapes = closed_shape(uint32_t(k));
        for (scene::Mesh& m : shapes)
            add_mesh(s, std::move(m), glm::translate(mat4(1), vec3(3.0f * float(k % 5) - 6, 2, 40.0f + 3.0f * float(k / 5))));
    }
    const scene::View view = scene::make_view({.eye = {0, 3, 6}, .target = {0, 0, 0}}, {64, 48}, s.bounds());
    const scene::Light light = scene::parse_light("sun,elevation=60,azimuth=30,angle=0", {}, s.bounds());
    shadow::SceneGpu scene(device(), s);
    gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, view.size);
    const std::unique_ptr<shadow::Technique> technique = technique_per_triangle_volumes.create(device());
    shadow::ParamValues params(technique_per_triangle_volumes.params());
    std::vector<shadow::Counter> counters;
    gpu::Buffer read = device().buffer({64, 0, gpu::Memory::read_back, "read"});
    gpu::PassList passes(device());
    const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
    technique->record(passes, {s, view, light, scene, g, passes.import(out), 0, nullptr, &counters}, params.bytes());
    std::map<std::string, uint32_t> numbers;
    for (size_t i = 0; i < counters.size(); ++i) passes.copy(counters[i].buffer, passes.import(read), 4, counters[i].offset, 4 * i);
    device().submit(std::move(passes));
    const std::vector<std::byte> bytes = device().read_back(read);
    for (size_t i = 0; i < counters.size(); ++i) std::memcpy(&numbers[counters[i].name], bytes.data() + 4 * i, 4);
    EXPECT_EQ(numbers["triangles"], s.triangle_count());
    EXPECT_GT(numbers["triangles_culled"], s.triangle_count() - 10);
    EXPECT_EQ(numbers["blocks_culled"], 20u * 2 * 3);
    EXPECT_LT(numbers["sample_tests"], 4u * 64 * 48);
    EXPECT_EQ(device().read_back(out).values, std::vector<float>(64 * 48, 1.0f));
}

/// As the paper counts it: 4.2 MB at 4096 x 4096 for the bits and two depths of 16 bits a tile.
TEST(DepthTree, TakesTheMemoryOfThePaper)
{
    const scene::View view = scene::make_view({}, {4096, 4096}, Bounds{vec3(-1), vec3(1)});
    const shaders::Tree tree = techniques::per_triangle_volumes::make_tree(view);
    const double bytes = 4.0 * tree.nodes + 4 * (32.0 * (tree.nodes - tree.first[2]) + 1);
    EXPECT_LT(bytes, 1.1 * 4.2e6);
}

TEST(DepthTree, CoversEveryPicture)
{
    for (const gpu::Size size :
        {gpu::Size{1, 1}, gpu::Size{8, 4}, gpu::Size{9, 4}, gpu::Size{1024, 1024}, gpu::Size{1025, 1}, gpu::Size{1, 5000}}) {
        const shaders::Tree tree = techniques::per_triangle_volumes::make_tree(scene::make_view({}, size, Bounds{vec3(-1), vec3(1)}));
        const uvec2 shift = shaders::tree_shift(tree.height);
        EXPECT_GE(1 << shift.x, size.width);
        EXPECT_GE(1 << shift.y, size.height);
        EXPECT_EQ(tree.first[tree.height] + 1, tree.nodes) << "one root";
    }
}

} // namespace
} // namespace gnomon
