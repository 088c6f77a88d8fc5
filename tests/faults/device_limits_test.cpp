// SPDX-License-Identifier: Apache-2.0
// What is larger than the device allows is refused by a sentence that names the limit, and nothing is left behind.
#include "base/error.h"
#include "lab/render.h"
#include "reliability.h"
#include "tests/gpu/technique_fixture.h"

namespace gnomon::tests {
namespace {

class DeviceLimits : public gpu::DeviceTest {
protected:
    static void note(const std::string& limit, const std::string& outcome)
    {
        record("limits", {{"limit", limit}, {"outcome", HasFailure() ? "**fails**" : outcome}});
    }
    template <class Action> static void expect_refused(const char* limit, const Action& action)
    {
        const uint64_t before = device().allocated_bytes();
        try {
            action();
            ADD_FAILURE() << "nothing names " << limit;
        } catch (const base::Error& e) {
            EXPECT_NE(std::string(e.what()).find(limit), std::string::npos) << e.what();
            note(fmt::format("beyond {}", limit), e.what());
        }
        EXPECT_LE(device().allocated_bytes(), before + 65536); // the pool may keep a list's constants
    }

    /// A render of a small scene with this technique as the command line has it.
    static lab::Rendered draw(const lab::Stage& stage, const char* choice)
    {
        shadow::SceneGpu scene(device(), stage.scene);
        return lab::render(device(), scene, stage, lab::parse_choice(choice), {.lit = false});
    }
};

TEST_F(DeviceLimits, ImagesBeyondTheLargestSide)
{
    const int side = int(device().limits().maxImageDimension2D) + 1;
    expect_refused("maxImageDimension2D", [&] { image("wide", VK_FORMAT_R8_UNORM, {side, 1}); });
    expect_refused("maxImageDimension2D", [&] { image("map", VK_FORMAT_D32_SFLOAT, {side, side}); });
    expect_refused("maxImageArrayLayers", [&] { image("deep", VK_FORMAT_R8_UNORM, {1, 1}, device().limits().maxImageArrayLayers + 1); });
}

TEST_F(DeviceLimits, ImagesWithMoreBytesThanOneMayHave)
{
    const int side = int(device().limits().maxImageDimension2D);
    try {
        image("huge", VK_FORMAT_R32G32B32A32_SFLOAT, {side, side}, 64);
        ADD_FAILURE() << "made " << double(side) * side * 16 * 64 << " bytes";
    } catch (const base::Error& e) {
        const std::string text = e.what();
        EXPECT_TRUE(text.find("maxResourceSize") != std::string::npos || text.find("maxMemoryAllocationSize") != std::string::npos
            || text.find("out of device memory") != std::string::npos)
            << text;
        note("an image of " + std::to_string(uint64_t(side) * uint64_t(side) * 1024) + " bytes", text);
    }
}

TEST_F(DeviceLimits, BuffersBeyondOneAllocation)
{
    VkPhysicalDeviceMaintenance4Properties sizes{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties pieces{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES, &sizes};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &pieces};
    reinterpret_cast<PFN_vkGetPhysicalDeviceProperties2>(::vkGetInstanceProcAddr(device().instance(), "vkGetPhysicalDeviceProperties2"))(
        device().physical(), &all);
    if (sizes.maxBufferSize < ~uint64_t(0))
        expect_refused("maxBufferSize", [&] { device().buffer({sizes.maxBufferSize + 1, 0, gpu::Memory::device, "vertices"}); });
    if (pieces.maxMemoryAllocationSize < sizes.maxBufferSize)
        expect_refused("maxMemoryAllocationSize", [&] {
            device().buffer({pieces.maxMemoryAllocationSize + 1, 0, gpu::Memory::device, "vertices"});
        });
}

TEST_F(DeviceLimits, BuffersThatShadersCannotReachToTheirEnd)
{
    const uint64_t most = device().limits().maxStorageBufferRange;
    if (most >= uint64_t(1) << 31) GTEST_SKIP() << "shaders of this device reach 2 GiB and more";
    gpu::Buffer large = device().buffer({most + 64, 0, gpu::Memory::device, "long list"});
    gpu::Buffer out = device().buffer({1600, 0, gpu::Memory::device, "out"});
    expect_refused("maxStorageBufferRange", [&] {
        gpu::PassList passes(device());
        passes.fill(passes.import(large), 0);
        passes.compute({.name = "twice",
            .program = &device().compute_program("tests/gpu/twice.comp"),
            .bindings = {{passes.import(large), gpu::Use::load}, {passes.import(out), gpu::Use::store}},
            .constants = uint32_t(1),
            .threads = {1}});
        device().submit(std::move(passes));
    });
}

TEST_F(DeviceLimits, SixtyFourLightsInOnePicture)
{
    lab::StageOptions options{.scene = "contact", .load = {.detail = 0.05}, .size = {48, 32}};
    for (int i = 0; i < 64; ++i) options.lights.push_back(fmt::format("sun,elevation={},azimuth={},angle=0", 20 + i, 11 * i % 360));
    const lab::Stage all = lab::open_stage(options);
    shadow::SceneGpu scene(device(), all.scene);
    const lab::Rendered together = lab::render(device(), scene, all, lab::parse_choice("shadow_map:map_size=256"), {});
    ASSERT_EQ(together.images.size(), 64u);
    for (const float v : together.radiance.values) ASSERT_TRUE(std::isfinite(v));
    for (const size_t one : {0, 31, 63}) {
        lab::Stage alone = all;
        alone.lights = {all.lights[one]};
        EXPECT_EQ(lab::render(device(), scene, alone, lab::parse_choice("shadow_map:map_size=256"), {}).images.front().values,
            together.images[one].values)
            << "light " << one << " among others";
    }
    note("64 lights in one picture, shadow_map", "works; each has the bits that it has alone");
}

TEST_F(DeviceLimits, FourThousandInstancesOfOneMesh)
{
    lab::Stage stage;
    scene::Scene& s = stage.scene;
    s.materials.emplace_back();
    gpu::add_quad(s, vec3(96, 0, 96), 100);
    scene::Mesh block; // four sides and no corners shared, so that it is closed whatever its normals
    block.positions = {{0, 0.2f, 0}, {1, 0.2f, 0}, {0, 0.2f, 1}, {0.2f, 2, 0.2f}};
    block.indices = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    scene::complete(block);
    s.meshes.push_back(block);
    for (int i = 0; i < 4096; ++i) s.instances.push_back({1, glm::translate(mat4(1), 3.0f * vec3(i % 64, 0, i / 64))});
    stage.bounds = s.bounds();
    stage.camera = scene::fit_camera(stage.bounds);
    stage.lights = {scene::parse_light("sun,elevation=30,azimuth=35,angle=0", {}, stage.bounds)};
    stage.view = scene::make_view(stage.camera, {160, 120}, stage.bounds);
    const std::vector<float> volumes = draw(stage, "shadow_volumes").images.front().values,
                             triangles = draw(stage, "per_triangle_volumes").images.front().values;
    ASSERT_EQ(volumes.size(), triangles.size());
    size_t differ = 0, dark = 0;
    for (size_t i = 0; i < volumes.size(); ++i) differ += volumes[i] != triangles[i], dark += triangles[i] < 0.5f;
    EXPECT_GT(dark, volumes.size() / 50);
    EXPECT_LT(differ, volumes.size() / 200) << "two exact techniques agree but on the rims of triangles";
    note("4,096 instances of one mesh, shadow_volumes and per_triangle_volumes",
        fmt::format("works; the two differ in {} of {} pixels", differ, volumes.size()));
}

} // namespace
} // namespace gnomon::tests
