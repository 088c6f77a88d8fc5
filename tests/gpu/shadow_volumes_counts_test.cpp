// SPDX-License-Identifier: Apache-2.0
// Where shadow volumes fail by the way they count, and where they must not: eyes in shadow, counters that overflow, panes that let light
// through.
#include "exact_suite.h"
#include "shadow/parts/volumes.h"

#include <cstring>
#include <map>

extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;

namespace gnomon {
namespace {

constexpr double closed = 0, bergeron = 1, any = 2;
constexpr double zpass = 0, zfail = 1, zp_plus = 2, pp_zp = 3;
constexpr double stencil = 1, blend = 2;
const char* const sun = "sun,elevation=50,azimuth=20,angle=0";
const char* const lamp = "point,position=1/3.5/1,radius=0";

class ShadowVolumes : public ExactTest {
protected:
    static ExactSubject with(std::vector<std::pair<const char*, double>> values)
    {
        return {technique_shadow_volumes, "volumes", std::move(values)};
    }

    struct Drawn {
        std::vector<float> values;
        std::map<std::string, uint32_t> counters;
        std::vector<std::string> passes;
    };
    /// With what it counted.
    static Drawn draw_counted(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* text, const Values& values)
    {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const scene::View view = scene::make_view(camera, size, s.bounds());
        shadow::ParamValues params(technique_shadow_volumes.params());
        for (const auto& [name, value] : values) params.set(name, value);
        shadow::SceneGpu scene(device(), s);
        gpu::Image out = image("visibility", shadow::output_format(technique_shadow_volumes, params.bytes(), light), size);
        const auto technique = technique_shadow_volumes.create(device());
        std::vector<shadow::Counter> counters;
        gpu::Buffer numbers = device().buffer({64, 0, gpu::Memory::device, "numbers"});
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        shadow::Frame frame{s, view, light, scene, g, passes.import(out), 0};
        frame.counters = &counters;
        technique->record(passes, frame, params.bytes());
        for (size_t i = 0; i < counters.size(); ++i) passes.copy(counters[i].buffer, passes.import(numbers), 4, counters[i].offset, 4 * i);
        Drawn drawn;
        for (const gpu::PassTime& t : device().submit(std::move(passes)).times) drawn.passes.push_back(t.name);
        drawn.values = device().read_back(out).values;
        const std::vector<std::byte> bytes = device().read_back(numbers);
        for (size_t i = 0; i < counters.size(); ++i) std::memcpy(&drawn.counters[counters[i].name], bytes.data() + 4 * i, 4);
        return drawn;
    }
};

TEST_F(ShadowVolumes, AnEyeInShadowIsCountedForByAllButZPass)
{
    scene::Scene s = soup(9, 60);
    gpu::add_quad(s, {3, 6, 5}, 2); // over the eye
    const char* overhead = "point,position=4/9/5,radius=0";
    EXPECT_GT(compare(with({{"count", zpass}}), s, oblique, {96, 64}, overhead).wrong, 1000u);
    for (const double count : {zfail, zp_plus, pp_zp})
        EXPECT_EQ(compare(with({{"count", count}}), s, oblique, {96, 64}, overhead).wrong, 0u) << count;
    const scene::Scene lit = soup(9, 60);
    EXPECT_EQ(compare(with({{"count", zpass}}), lit, oblique, {96, 64}, overhead).wrong, 0u) << "where the eye is lit it is right";
}

/// Panes over one another above a floor, all of which lies under them.
scene::Scene panes(int count)
{
    scene::Scene s = floor_scene(1);
    for (int i = 0; i < count; ++i) gpu::add_quad(s, {0, 1 + 0.01f * float(i), 0}, 3);
    return s;
}

TEST_F(ShadowVolumes, CountersDoNotWrapTo0)
{
    const scene::Camera below{.eye = {0, 0.9f, 0.5f}, .target = {0, 0, 0}};
    const char* high = "point,position=0.3/9/0.2,radius=0";
    const auto names_stencil = [](const Drawn& d) {
        return std::any_of(d.passes.begin(), d.passes.end(), [](const std::string& n) { return n.find("(stencil)") != std::string::npos; });
    };
    for (const int count : {1, 126, 255, 256, 257, 512})
        for (const double by : {stencil, blend})
            for (const double from : {zfail, pp_zp, zp_plus}) {
                const Drawn d = draw_counted(panes(count), below, {32, 24}, high, {{"counter", by}, {"count", from}});
                EXPECT_EQ(names_stencil(d), by == stencil && from == zfail && 2 * count + 2 < 256) << count;
                EXPECT_EQ(mean(d.values), 0.0) << count << " panes, counter " << by << ", count " << from;
            }
    // the same bits by a stencil as by additions
    const scene::Scene s = soup(21, 120);
    for (const char* light : {sun, lamp})
        for (const double count : {zpass, zfail})
            for (const double edges : {closed, bergeron, any}) {
                const auto by = [&](double counter) {
                    return draw(with({{"count", count}, {"edges", edges}, {"counter", counter}}), s, oblique, {96, 64}, light);
                };
                EXPECT_EQ(by(stencil), by(blend)) << light << ", count " << count << ", edges " << edges;
            }
}

TEST_F(ShadowVolumes, PanesMultiplyWhatTheyLetThrough)
{
    const vec4 colors[] = {{0.8f, 0.1f, 0.3f, 0.5f}, {0.2f, 0.9f, 0.4f, 0.3f}, {0.5f, 0.5f, 1, 0.7f}, {1, 1, 1, 0.25f}};
    for (int count = 0; count <= 8; ++count) {
        scene::Scene s = floor_scene(1);
        vec3 expected(1);
        for (int i = 0; i < count; ++i) {
            scene::Material m;
            m.double_sided = true, m.alpha = scene::AlphaMode::blend, m.base_color = colors[i % 4];
            expected *= scene::transmittance(m, m.base_color);
            gpu::add_quad(s, {0, 1 + 0.1f * float(i), 0}, 3);
            s.meshes.back().material = int(s.materials.size());
            s.materials.push_back(m);
        }
        for (const bool shut : {false, true}) {
            if (shut) gpu::add_quad(s, {0, 0.9f, 2.5f}, 2.5f); // opaque over half of the floor, z > 0
            for (const double count_from : {zfail, pp_zp, zp_plus}) {
                const std::vector<float> got
                    = TechniqueTest::draw(technique_shadow_volumes, s, {.eye = {0, 0.8f, 0.01f}, .target = {0, 0, 0}}, {16, 12},
                        "sun,elevation=90,angle=0", {{"log_alpha", 1}, {"count", count_from}});
                ASSERT_EQ(got.size(), 16u * 12 * 4);
                for (size_t i = 0; i < got.size(); i += 4) {
                    const bool dark = shut && i / 4 / 16 >= 6;
                    for (size_t k = 0; k < 3; ++k)
                        ASSERT_NEAR(got[i + k], dark ? 0.0f : expected[int(k)], 1e-3f)
                            << count << " panes, from " << count_from << ", pixel " << i / 4;
                }
            }
        }
    }
}

TEST_F(ShadowVolumes, TheScissorLeavesOutWhatChangesNothing)
{
    const scene::Scene s = soup(12, 120);
    const char* narrow = "spot,position=1/3/0,target=0/0/0,cone=24,radius=0";
    const Drawn all = draw_counted(s, oblique, {128, 96}, narrow, {{"scissor", 0}});
    const Drawn cut = draw_counted(s, oblique, {128, 96}, narrow, {{"scissor", 1}});
    EXPECT_EQ(all.values, cut.values);
    EXPECT_LT(cut.counters.at("fragments"), all.counters.at("fragments") / 2);
    EXPECT_EQ(cut.counters.at("stencil_updates"), all.counters.at("stencil_updates"));
    EXPECT_GT(mean(cut.values), 0.0);
}

TEST_F(ShadowVolumes, DepthTestsPutNoMoreThanSinglePixelsWrong)
{
    size_t off = 0;
    for (uint32_t seed = 0; seed < 12; ++seed) {
        const scene::Scene s = soup(seed, 120);
        for (const double count : {zfail, pp_zp}) {
            const Drawn by_depth = draw_counted(s, oblique, {96, 64}, lamp, {{"count", count}, {"order", 1}});
            const Drawn by_planes = draw_counted(s, oblique, {96, 64}, lamp, {{"count", count}});
            EXPECT_LT(by_depth.counters.at("fragments"), by_planes.counters.at("fragments"));
            size_t here = 0;
            for (size_t i = 0; i < by_depth.values.size(); ++i) here += by_depth.values[i] != by_planes.values[i];
            EXPECT_LT(here, 6u) << seed;
            off += here;
        }
    }
    EXPECT_GT(off, 0u) << "or planes are not needed";
}

TEST_F(ShadowVolumes, WorkIsCounted)
{
    // a floor and a sheet, of two triangles and four borders each
    const scene::Scene s = gpu::half_shadowed();
    const Drawn by_zfail = draw_counted(s, gpu::camera_above({0, 0, 0}, 0.5f, 4), {64, 64}, "point,position=0/5/0,radius=0", {});
    EXPECT_EQ(by_zfail.counters.at("volume_quads"), 8u);
    EXPECT_EQ(by_zfail.counters.at("caps"), 4u); // what is at infinity of parallel rays is no cap
    const Drawn seen = draw_counted(s, oblique, {64, 64}, "point,position=0/5/0,radius=0", {});
    EXPECT_EQ(seen.counters.at("caps"), 8u);
    EXPECT_GT(seen.counters.at("stencil_updates"), 0u);
    EXPECT_GE(seen.counters.at("fragments"), seen.counters.at("stencil_updates"));
    const Drawn by_zpass = draw_counted(s, oblique, {64, 64}, "point,position=0/5/0,radius=0", {{"count", zpass}});
    EXPECT_EQ(by_zpass.counters.at("caps"), 0u);
    EXPECT_EQ(by_zpass.values, seen.values);
}

/// More edges than one step takes.
TEST_F(ShadowVolumes, AMillionEdgesAreAllDrawn)
{
    scene::Scene s = floor_scene(4);
    scene::Mesh m;
    constexpr uint32_t n = 620;
    for (uint32_t z = 0; z <= n; ++z)
        for (uint32_t x = 0; x <= n; ++x) m.positions.push_back({-1.5f + 3.0f * float(x) / n, 2, -1.5f + 3.0f * float(z) / n});
    for (uint32_t z = 0; z < n; ++z)
        for (uint32_t x = 0; x < n; ++x) {
            const uint32_t a = z * (n + 1) + x, b = a + n + 1;
            m.indices.insert(m.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    add_mesh(s, m);
    scene::Scene plain = floor_scene(4);
    gpu::add_quad(plain, {0, 2, 0}, 1.5f);
    const scene::Camera below{.eye = {0, 1.5f, 3.5f}, .target = {0, 0, 0}};
    const Drawn fine = draw_counted(s, below, {64, 48}, lamp, {}), coarse = draw_counted(plain, below, {64, 48}, lamp, {});
    EXPECT_EQ(fine.values, coarse.values);
    EXPECT_EQ(fine.counters.at("volume_quads"), 4 * n + 4);
    EXPECT_EQ(fine.counters.at("caps"), 2 * (2 * n * n + 2));
    EXPECT_EQ(std::count(fine.passes.begin(), fine.passes.end(), "volumes"), 2);
}

} // namespace
} // namespace gnomon
