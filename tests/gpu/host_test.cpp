// SPDX-License-Identifier: Apache-2.0
#include "host_fixture.h"

// The library as an engine uses it: handles in, an image out, against the same technique in Gnomon's own frame.
namespace gnomon::gpu {

namespace {

constexpr Size size{160, 120};

struct Case {
    const char *technique, *light, *settings;
};

double differing(const std::vector<float>& a, const std::vector<float>& b)
{
    EXPECT_EQ(a.size(), b.size());
    size_t count = 0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += std::abs(a[i] - b[i]) > 0.02f;
    return double(count) / double(a.size());
}

} // namespace

class Host : public HostTest {
protected:
    /// What the host drew: its depth, and the normals of triangles, in its conventions.
    struct Drawn {
        Image depth, normals;
    };

    enum class Receivers { depth, depth_and_normals, drawn_by_gnomon };

    /// One picture of the scene by the library.
    static std::vector<float> shadows(const scene::Scene& s, const scene::Camera& camera, const Case& c, const Conventions& conventions,
        Receivers receivers = Receivers::depth)
    {
        const HostScene host = host_scene(s, conventions, true);
        const gnomon::Device library(device_info());
        const gnomon::Scene casters(library, host.info);
        const gnomon::Shadow shadow(casters, c.technique, c.settings);
        gnomon_frame frame{};
        frame.light = host_light(scene::parse_light(c.light, {}, s.bounds()), conventions);
        aim(frame, camera, size, conventions, near, far);
        Drawn drawn = draw_as_host(s, camera, frame, conventions);
        if (receivers != Receivers::drawn_by_gnomon) frame.depth = host_image(drawn.depth, drawn.depth.state().parts[0].layout);
        if (receivers == Receivers::depth_and_normals) frame.normals = host_image(drawn.normals, drawn.normals.state().parts[0].layout);
        frame.normal_encoding = GNOMON_NORMAL_SIGNED | GNOMON_NORMAL_GEOMETRIC;
        Image out = image("shadow", VK_FORMAT_R8G8B8A8_UNORM, size);
        frame.output = host_image(out, VK_IMAGE_LAYOUT_UNDEFINED);
        Commands commands;
        frame.commands = commands.begin();
        const uint64_t ticket = shadow.record(frame);
        Commands::finish(frame.commands);
        library.retire(ticket);
        return red_of(out);
    }

    /// What the library left in SHADER_READ_ONLY_OPTIMAL.
    static std::vector<float> red_of(const Image& out)
    {
        Image left = device().adopt_image(out.handle(), out.desc(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        const base::Picture picture = device().read_back(left);
        std::vector<float> red;
        for (size_t i = 0; i < picture.values.size(); i += 4) red.push_back(picture.values[i]);
        return red;
    }

    static Drawn draw_as_host(const scene::Scene& s, const scene::Camera& camera, const gnomon_frame& frame, const Conventions& c)
    {
        const scene::View view = scene::make_view(camera, size, s.bounds());
        shadow::SceneGpu scene(device(), s);
        Image depth = image("depth", VK_FORMAT_D32_SFLOAT, size), normals = image("normals", VK_FORMAT_R32G32_UINT, size);
        PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        passes.copy(g.depth, passes.import(depth));
        passes.copy(g.normal, passes.import(normals));
        device().submit(std::move(passes));
        std::vector<float> depths = device().read_back(depth).values;
        const std::vector<std::byte> codes = device().read_back_bytes(normals);
        std::vector<vec4> directions(depths.size(), vec4(0));
        const glm::dmat4 clip_from_host = matrix(frame.clip_from_view) * matrix(frame.view_from_world), world = host_from_world(c);
        for (size_t i = 0; i < depths.size(); ++i) {
            uint32_t code;
            std::memcpy(&code, codes.data() + 8 * i + 4, 4);
            directions[i] = vec4(vec3(glm::normalize(glm::dmat3(world) * decoded(code))), 0);
            const double x = (double(i % size_t(size.width)) + 0.5) / size.width * 2 - 1,
                         y = (double(i / size_t(size.width)) + 0.5) / size.height * 2 - 1;
            const glm::dvec4 p = glm::dmat4(view.world_from_clip) * glm::dvec4(x, y, double(depths[i]), 1);
            const glm::dvec4 clip = clip_from_host * world * glm::dvec4(glm::dvec3(p) / p.w, 1);
            depths[i] = depths[i] == 0.0f ? frame.background : float(clip.z / clip.w);
        }
        Drawn out{image("host depth", c.depth_format, size), image("host normals", VK_FORMAT_R32G32B32A32_SFLOAT, size)};
        device().upload(out.depth, std::as_bytes(std::span(depths)));
        device().upload(out.normals, std::as_bytes(std::span(directions)));
        return out;
    }

    static glm::dvec3 decoded(uint32_t code)
    {
        glm::dvec2 e(int16_t(code & 0xffff) / 32767.0, int16_t(code >> 16) / 32767.0);
        const double z = 1 - std::abs(e.x) - std::abs(e.y);
        if (z < 0) e = {(1 - std::abs(e.y)) * (e.x >= 0 ? 1 : -1), (1 - std::abs(e.x)) * (e.y >= 0 ? 1 : -1)};
        return glm::normalize(glm::dvec3(e, z));
    }

    static glm::dmat4 matrix(const float (&m)[16])
    {
        glm::dmat4 out;
        for (int i = 0; i < 16; ++i) out[i / 4][i % 4] = double(m[i]);
        return out;
    }

    static scene::Scene contact() { return scene::load("contact"); }
    static scene::Camera camera_of(const scene::Scene& s) { return s.cameras.empty() ? scene::fit_camera(s.bounds()) : s.cameras.front(); }

    static constexpr double near = 0.05, far = 200.0;
};

TEST_F(Host, MapVolumeAndSoftAgreeWithGnomonsOwnFrame)
{
    const scene::Scene s = contact();
    const Case cases[] = {{"shadow_map", "directional,elevation=40,azimuth=30", ""}, {"shadow_volumes", "point,position=1/4/2", ""},
        {"pcss", "disk,position=1/4/2,target=0/0/0,radius=0.4", ""}, {"vsm", "spot,position=2/5/2,target=0/0/0,cone=40", ""},
        {"alias_free", "directional,elevation=40,azimuth=30", ""}, {"ray_traced", "point,position=1/4/2", ""},
        {"virtual_shadow_map", "directional,elevation=40,azimuth=30", ""}, {"per_triangle_volumes", "point,position=1/4/2", ""}};
    for (const Case& c : cases) {
        const shadow::TechniqueInfo& info = shadow::technique(c.technique);
        if (info.unavailable && !info.unavailable(device()).empty()) continue;
        const std::vector<float> own = draw(info, s, camera_of(s), size, c.light, {});
        std::vector<float> grey;
        const size_t channels = own.size() / size_t(size.area());
        for (size_t i = 0; i < own.size(); i += channels) grey.push_back(own[i]);
        const double with = differing(shadows(s, camera_of(s), c, {}, Receivers::depth_and_normals), grey);
        const double without = differing(shadows(s, camera_of(s), c, {}, Receivers::depth), grey);
        const double drawn = differing(shadows(s, camera_of(s), c, {}, Receivers::drawn_by_gnomon), grey);
        std::printf("%-22s %.4f %.4f %.4f of the pixels differ\n", c.technique, with, without, drawn);
        const bool grid
            = info.id == std::string_view("virtual_shadow_map"); // its pages lie about the origin, which is the casters' centre here
        EXPECT_LE(with, grid ? 0.06 : 0.003) << c.technique;
        // where surfaces are a pixel wide there are no neighbours to take a normal from
        EXPECT_LE(without, grid ? 0.08 : 0.05) << c.technique;
        EXPECT_LE(drawn, grid ? 0.06 : 0.001) << c.technique;
        EXPECT_LT(mean(grey), 0.98) << c.technique << ": the case has no shadow";
    }
}

TEST_F(Host, ConventionsDoNotChangeShadows)
{
    const scene::Scene s = contact();
    Conventions z_up{{2, VK_FALSE, 0.01f}}, unreal{{2, VK_TRUE, 0.01f}}, unity{{1, VK_TRUE, 1.0f}}, x_up{{0, VK_FALSE, 1.0f}};
    unreal.reversed = true, unreal.clockwise = true, unreal.depth_format = VK_FORMAT_R32_SFLOAT;
    unity.y_up = true, unity.reversed = false;
    x_up.short_indices = true, x_up.snorm = true;
    z_up.reversed = false, z_up.y_up = true, z_up.short_indices = true;
    Conventions far_off{{1, VK_FALSE, 1.0f}};
    far_off.origin = {256, 0, -512}; // farther off the float matrices themselves lose more than the map's bias (0.5 mm at 8 km)
    const std::pair<const char*, Conventions> all[] = {{"z up, centimetres", z_up}, {"z up, left-handed, clockwise", unreal},
        {"left-handed, y up in clip space", unity}, {"x up, 16 bits", x_up}, {"far from the origin", far_off}};
    for (const Case& c :
        {Case{"shadow_map", "directional,elevation=40,azimuth=30", ""}, Case{"pcss", "disk,position=1/4/2,target=0/0/0,radius=0.4", ""},
            Case{"alias_free", "spot,position=2/5/2,target=0/0/0,cone=40", ""}}) {
        const std::vector<float> expected = shadows(s, camera_of(s), c, {});
        for (const auto& [name, conventions] : all) {
            const double share = differing(shadows(s, camera_of(s), c, conventions), expected);
            std::printf("%-12s %-32s %.4f\n", c.technique, name, share);
            EXPECT_LE(share, 0.005) << c.technique << ", " << name;
        }
    }
}

} // namespace gnomon::gpu
