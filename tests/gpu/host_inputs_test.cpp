// SPDX-License-Identifier: Apache-2.0
#include "host_fixture.h"

// What else a renderer may hand over: masked materials, skinned meshes, multisampled depth, motion.
namespace gnomon::gpu {

namespace {

constexpr Size size{96, 64};
constexpr const char* sun = "directional,elevation=70,azimuth=20";

} // namespace

class HostInputs : public HostTest {
protected:
    static scene::Camera above() { return {.eye = {0, 6, 5}, .target = {0, 0, 0}}; }

    static std::vector<float> once(const gnomon::Device& library, const gnomon::Shadow& shadow, gnomon_frame frame)
    {
        Image out = image("shadow", VK_FORMAT_R32_SFLOAT, size);
        frame.output = host_image(out, VK_IMAGE_LAYOUT_GENERAL);
        PassList passes(device()); // the layout that the frame states
        passes.clear(passes.import(out), {});
        device().submit(std::move(passes));
        frame.output.layout = out.state().parts[0].layout;
        Commands commands;
        frame.commands = commands.begin();
        const uint64_t ticket = shadow.record(frame);
        Commands::finish(frame.commands);
        library.retire(ticket);
        return device().read_back(out).values; // still in that layout
    }

    static gnomon_frame frame_of(const scene::Scene& s, const scene::Camera& camera)
    {
        gnomon_frame frame{};
        frame.light = host_light(scene::parse_light(sun, {}, s.bounds()), {});
        aim(frame, camera, size, {}, 0.05, 100);
        return frame;
    }

    /// A host's own view of a texture and a sampler.
    struct Texture {
        explicit Texture(Image&& i)
            : image(std::move(i))
        {
            view = image.view(VK_IMAGE_VIEW_TYPE_2D, 0, 1, 0, 1, VK_IMAGE_ASPECT_COLOR_BIT);
            VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
            info.addressModeU = info.addressModeV = VK_SAMPLER_ADDRESS_MODE_REPEAT;
            call<PFN_vkCreateSampler>("vkCreateSampler")(device().handle(), &info, nullptr, &sampler);
        }
        ~Texture() { call<PFN_vkDestroySampler>("vkDestroySampler")(device().handle(), sampler, nullptr); }
        Texture(const Texture&) = delete;
        Texture& operator=(const Texture&) = delete;
        Image image;
        VkImageView view;
        VkSampler sampler = VK_NULL_HANDLE;
    };
};

TEST_F(HostInputs, MaskedCastersHaveTheHolesOfTheHostsTexture)
{
    scene::Scene s = half_shadowed();
    s.materials.push_back({.base_color_texture = {.texture = 0}, .alpha = scene::AlphaMode::mask, .double_sided = true});
    s.meshes[1].material = 1;
    s.meshes[1].uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    std::vector<uint8_t> texels(8 * 8 * 4, 255);
    for (size_t i = 0; i < 64; ++i) texels[4 * i + 3] = (i / 8 + i) % 2 ? 255 : 0;
    s.textures.push_back({.name = "holes", .width = 8, .height = 8, .rgba = texels, .linear = false});

    HostScene host = host_scene(s, {}, true);
    Image holes = image("holes", VK_FORMAT_R8G8B8A8_UNORM, {8, 8});
    device().upload(holes, std::as_bytes(std::span(texels)));
    const Texture texture(std::move(holes));
    host.materials[1].texture = texture.view, host.materials[1].sampler = texture.sampler;
    std::vector<vec2> uvs = s.meshes[1].uvs;
    host.buffers.push_back(storage<vec2>("uvs", uvs));
    host.meshes[1].texture_coordinates = {host.buffers.back().handle(), 0, 8, VK_FORMAT_R32G32_SFLOAT};

    const gnomon::Device library(device_info());
    const gnomon::Scene casters(library, host.info);
    for (const char* id : {"shadow_map", "alias_free", "per_triangle_volumes"}) {
        const std::vector<float> own = draw(shadow::technique(id), s, above(), size, sun, {});
        const std::vector<float> hosts = once(library, gnomon::Shadow(casters, id), frame_of(s, above()));
        size_t differing = 0;
        for (size_t i = 0; i < own.size(); ++i) differing += std::abs(own[i] - hosts[i]) > 0.02f;
        EXPECT_LE(differing, own.size() / 200) << id;
        EXPECT_GT(mean(own), 0.5) << id;
        EXPECT_LT(mean(own), 0.99) << id;
    }
}

TEST_F(HostInputs, DeformedMeshesAreReadAgain)
{
    const scene::Scene s = half_shadowed();
    scene::Scene bent = s;
    for (vec3& p : bent.meshes[1].positions) p = {p.x + 1.0f, p.y + 0.5f, 0.5f * p.z};
    bent.meshes[1].bounds = {};
    for (const vec3& p : bent.meshes[1].positions) bent.meshes[1].bounds.add(p);
    HostScene host = host_scene(s, {}, false);
    const HostScene other = host_scene(bent, {}, false);
    const gnomon::Device library(device_info());
    const gnomon::Scene casters(library, host.info);
    for (const char* id : {"shadow_map", "alias_free", "ray_traced"}) {
        const shadow::TechniqueInfo& info = shadow::technique(id);
        if (info.unavailable && !info.unavailable(device()).empty()) continue;
        const gnomon::Shadow shadow(casters, id);
        const auto write = [&](const scene::Mesh& mesh) {
            for (size_t v = 0; v < mesh.positions.size(); ++v) // as add_mesh lays them
                device().upload(host.buffers[2], std::as_bytes(std::span(&mesh.positions[v], 1)), 8 + 20 * v);
            const vec3 a = mesh.bounds.min, b = mesh.bounds.max;
            casters.deform(1, {a.x, a.y, a.z}, {b.x, b.y, b.z});
        };
        write(s.meshes[1]);
        const std::vector<float> first = once(library, shadow, frame_of(s, above()));
        write(bent.meshes[1]);
        const std::vector<float> second = once(library, shadow, frame_of(s, above()));
        const std::vector<float> own = draw(info, bent, above(), size, sun, {});
        EXPECT_NE(first, second) << id;
        size_t differing = 0;
        for (size_t i = 0; i < own.size(); ++i) differing += std::abs(own[i] - second[i]) > 0.02f;
        EXPECT_LE(differing, own.size() / 200) << id;
    }
}

TEST_F(HostInputs, MultisampledDepthAndMotionAreTaken)
{
    const scene::Scene s = half_shadowed();
    const HostScene host = host_scene(s, {}, true);
    const gnomon::Device library(device_info());
    const gnomon::Scene casters(library, host.info);
    const gnomon::Shadow shadow(casters, "pcf");
    // a wall that stands 6.5 m before the eye, parallel to the picture
    const auto wall = [&](VkSampleCountFlagBits samples) {
        Image depth = device().image({VK_FORMAT_D32_SFLOAT, size, 1, 1, samples, false, "wall"});
        PassList passes(device());
        passes.raster({.name = "wall",
            .program = &device().raster_program("shaders/fullscreen.vert", ""),
            .depth = DepthTarget{.image = passes.import(depth), .clear = 0.05f / 6.5f, .write = false, .compare = VK_COMPARE_OP_NEVER},
            .draw = [](Encoder&) {}});
        device().submit(std::move(passes));
        return depth;
    };
    Image one = wall(VK_SAMPLE_COUNT_1_BIT), four = wall(VK_SAMPLE_COUNT_4_BIT), motion = image("motion", VK_FORMAT_R16G16_SFLOAT, size);
    const std::vector<uint32_t> still(size_t(size.area()), 0);
    device().upload(motion, std::as_bytes(std::span(still)));
    gnomon_frame frame = frame_of(s, above()), moved = frame;
    // the first of four samples lies at (0.375, 0.125) of a pixel: what is seen there stands at the centre of a picture moved by the rest
    const float shift[2] = {2 * (0.5f - 0.375f) / float(size.width), 2 * (0.5f - 0.125f) / float(size.height)};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 2; ++row) moved.clip_from_view[4 * column + row] += shift[row] * moved.clip_from_view[4 * column + 3];
    moved.depth = host_image(one, one.state().parts[0].layout);
    const std::vector<float> expected = once(library, shadow, moved);
    EXPECT_LT(mean(expected), 0.99);
    frame.depth = host_image(four, four.state().parts[0].layout);
    frame.motion = host_image(motion, motion.state().parts[0].layout);
    const std::vector<float> taken = once(library, shadow, frame);
    for (size_t i = 0; i < taken.size(); ++i) ASSERT_NEAR(taken[i], expected[i], 0.01f) << i;

    // what a technique draws itself lies at the centres of pixels, whatever the host's depth
    const gnomon::Shadow drawn(casters, "alias_free");
    gnomon_frame none = frame;
    none.depth = none.motion = {};
    EXPECT_EQ(once(library, drawn, frame), once(library, drawn, none));
}

} // namespace gnomon::gpu
