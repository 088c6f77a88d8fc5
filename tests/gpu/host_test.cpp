// SPDX-License-Identifier: Apache-2.0
#include "host_fixture.h"

#include <thread>

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
    /// One picture of the scene by the library.
    static std::vector<float> shadows(
        const scene::Scene& s, const scene::Camera& camera, const Case& c, const Conventions& conventions, bool with_depth = true)
    {
        const HostScene host = host_scene(s, conventions, true);
        const gnomon::Device library(device_info());
        const gnomon::Scene casters(library, host.info);
        const gnomon::Shadow shadow(casters, c.technique, c.settings);
        gnomon_frame frame{};
        frame.light = host_light(scene::parse_light(c.light, {}, s.bounds()), conventions);
        aim(frame, camera, size, conventions, near, far);
        Image depth = host_depth(s, camera, conventions);
        if (with_depth) frame.depth = host_image(depth, depth.state().parts[0].layout);
        Image out = image("shadow", VK_FORMAT_R8G8B8A8_UNORM, size);
        frame.output = host_image(out, VK_IMAGE_LAYOUT_UNDEFINED);
        Commands commands;
        frame.commands = commands.begin();
        library.retire(shadow.record(frame));
        Commands::finish(frame.commands);
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

    /// The depth as a host of these conventions has it.
    static Image host_depth(const scene::Scene& s, const scene::Camera& camera, const Conventions& c)
    {
        const scene::View view = scene::make_view(camera, size, s.bounds());
        shadow::SceneGpu scene(device(), s);
        Image kept = image("depth", VK_FORMAT_D32_SFLOAT, size);
        PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        passes.copy(g.depth, passes.import(kept));
        device().submit(std::move(passes));
        std::vector<float> values = device().read_back(kept).values;
        for (float& d : values) {
            const double distance = d > 0 ? double(view.near) / double(d) : 0.0;
            d = distance == 0.0 ? (c.reversed ? 0.0f : 1.0f)
                : c.reversed    ? float(near / distance)
                                : float(far / (far - near) - near * far / (far - near) / distance);
        }
        Image out = image("host depth", c.depth_format, size);
        device().upload(out, std::as_bytes(std::span(values)));
        return out;
    }

    static scene::Scene contact() { return scene::load("contact"); }
    static scene::Camera camera_of(const scene::Scene& s) { return s.cameras.empty() ? scene::fit_camera(s.bounds()) : s.cameras.front(); }

    static constexpr double near = 0.05, far = 200.0;
};

TEST_F(Host, MapVolumeAndSoftAgreeWithGnomonsOwnFrame)
{
    const scene::Scene s = contact();
    const Case cases[] = {{"shadow_map", "directional,elevation=40,azimuth=30", ""}, {"shadow_volumes", "point,at=1/4/2", ""},
        {"pcss", "disk,at=1/4/2,to=0/0/0,radius=0.4", ""}, {"vsm", "spot,at=2/5/2,to=0/0/0,outer=40", ""},
        {"alias_free", "directional,elevation=40,azimuth=30", ""}, {"ray_traced", "point,at=1/4/2", ""},
        {"virtual_shadow_map", "directional,elevation=40,azimuth=30", ""}, {"per_triangle_volumes", "point,at=1/4/2", ""}};
    for (const Case& c : cases) {
        const shadow::TechniqueInfo& info = shadow::technique(c.technique);
        if (info.unavailable && !info.unavailable(device()).empty()) continue;
        const std::vector<float> own = draw(info, s, camera_of(s), size, c.light, {});
        std::vector<float> grey;
        const size_t channels = own.size() / size_t(size.area());
        for (size_t i = 0; i < own.size(); i += channels) grey.push_back(own[i]);
        const double share = differing(shadows(s, camera_of(s), c, {}), grey);
        std::printf("%-22s %.4f of the pixels differ\n", c.technique, share);
        // along edges of the picture's surfaces the library has no neighbours to take a normal from
        EXPECT_LE(share, 0.01) << c.technique;
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
    far_off.origin = {4096, 0, -8192}; // a whole number of floats' steps at these sizes
    const std::pair<const char*, Conventions> all[] = {{"z up, centimetres", z_up}, {"z up, left-handed, clockwise", unreal},
        {"left-handed, y up in clip space", unity}, {"x up, 16 bits", x_up}, {"far from the origin", far_off}};
    for (const Case& c : {Case{"shadow_map", "directional,elevation=40,azimuth=30", ""},
             Case{"pcss", "disk,at=1/4/2,to=0/0/0,radius=0.4", ""}, Case{"alias_free", "spot,at=2/5/2,to=0/0/0,outer=40", ""}}) {
        const std::vector<float> expected = shadows(s, camera_of(s), c, {});
        for (const auto& [name, conventions] : all) {
            const double share = differing(shadows(s, camera_of(s), c, conventions), expected);
            std::printf("%-12s %-32s %.4f\n", c.technique, name, share);
            EXPECT_LE(share, 0.005) << c.technique << ", " << name;
        }
    }
}

} // namespace gnomon::gpu
