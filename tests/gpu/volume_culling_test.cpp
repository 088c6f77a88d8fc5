// SPDX-License-Identifier: Apache-2.0
// No aid may take away a shadow: against every triangle of every instance, in double precision, at every pixel.
#include "exact_suite.h"

#include "scene/load.h"
#include "shadow/parts/volume_culling.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;

namespace gnomon {
namespace {

using shadow::parts::VolumeCulling;

class VolumeCullingTest : public ExactTest {
protected:
    static constexpr gpu::Size picture{96, 64};

    struct Result {
        std::vector<uint32_t> slots; ///< by instance of the scene
        shaders::VolumeBands bands;
        uint32_t casters_culled = 0, bands_culled = 0;
    };

    static Result cull(const scene::Scene& s, const scene::View& view, const scene::Light& light, const VolumeCulling& culling)
    {
        shadow::SceneGpu scene(device(), s);
        gpu::Image out = image("out", VK_FORMAT_R32_SFLOAT, view.size);
        gpu::Buffer slots = storage<uint32_t>("slots", scene.slot_count()), counts = storage<uint32_t>("counts", 2);
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        std::vector<shadow::Counter> counters;
        const shadow::Frame frame{s, view, light, scene, g, passes.import(out), 0, nullptr, &counters};
        const shadow::parts::CulledVolumes culled = shadow::parts::cull_volumes(passes, frame, culling);
        passes.copy(culled.slots, passes.import(slots), scene.slot_count() * sizeof(uint32_t));
        for (size_t i = 0; i < 2; ++i) passes.copy(counters.at(i).buffer, passes.import(counts), 4, counters.at(i).offset, 4 * i);
        device().submit(std::move(passes));
        Result r;
        r.bands = culled.bands;
        const std::vector<uint32_t> by_slot = values<uint32_t>(slots);
        r.slots.resize(s.instances.size());
        for (const auto& d : scene.drawables()) r.slots[d.instance] = by_slot[d.slot];
        r.casters_culled = values<uint32_t>(counts)[0], r.bands_culled = values<uint32_t>(counts)[1];
        return r;
    }

    /// What the pixels of a picture lose. `alone`: each caster must be there that darkens a pixel; else one of them.
    struct Loss {
        size_t lost = 0, dark = 0;
    };
    static Loss losses(const scene::Scene& s, const scene::Camera& camera, const scene::Light& light, const Result& r, bool alone)
    {
        const HardTruth truth(s, light);
        std::vector<size_t> instance_of;
        for (size_t i = 0; i < s.instances.size(); ++i)
            instance_of.insert(instance_of.end(), s.meshes[size_t(s.instances[i].mesh)].indices.size() / 3, i);
        Loss loss;
        for (const Seen& seen : receivers(truth, s, camera, picture)) {
            if (seen.own == SIZE_MAX || seen.facing < 0.02) continue;
            const size_t own = seen.own;
            const dvec3 p = seen.p, n = seen.n;
            if (glm::dot(n, glm::normalize(truth.to_light(p))) < 1e-3 || !scene::reaches(light, vec3(p))) continue;
            bool dark = false, kept = false, all_kept = true;
            for (size_t t = 0; t < truth.triangles().size(); ++t) {
                const Verdict v = t == own ? Verdict::lit : truth.behind(truth.triangles()[t], p);
                if (v == Verdict::lit) continue;
                const bool here = (r.slots[instance_of[t]] >> band_of(r.bands, p) & 1u) != 0;
                dark = dark || v == Verdict::dark;
                kept = kept || here;
                all_kept = all_kept && (here || v == Verdict::unknown);
            }
            loss.dark += dark;
            loss.lost += dark && !(alone ? all_kept : kept);
        }
        return loss;
    }
    static uint32_t band_of(const shaders::VolumeBands& bands, dvec3 p)
    {
        uint32_t band = 0;
        for (uint32_t b = 1; b < bands.count; ++b) band += glm::dot(glm::dvec4(bands.planes[b]), glm::dvec4(p, 1)) >= 0;
        return band;
    }

    /// Instances of a few triangles each, at all heights, some below the floor, some huge.
    static scene::Scene crowd(uint32_t seed, int instances)
    {
        scene::Scene s = gpu::floor_scene(4);
        Uniform uniform(seed);
        for (int i = 0; i < instances; ++i) {
            scene::Mesh m;
            const float size = 0.1f + 2.0f * std::pow(uniform(0, 1), 4.0f);
            for (uint32_t k = 0; k < 3u * (1u + uint32_t(i) % 3u); ++k) {
                m.indices.push_back(k);
                m.positions.push_back(size * uniform.in_cube());
            }
            add_mesh(s, std::move(m), glm::translate(mat4(1), 3.0f * uniform.in_cube() + vec3(0, 0.5f, 0)));
        }
        return s;
    }

    /// Two floors, the upper of which covers the lower, with small squares below, between and above.
    static scene::Scene two_floors(int each)
    {
        scene::Scene s = gpu::floor_scene(4);
        gpu::add_quad(s, {0, 2, 0}, 4);
        for (int i = 0; i < 3 * each; ++i)
            gpu::add_quad(s, {float(i % 7) - 3, 2.0f * float(i / each) - 1 + 0.1f * float(i % 3), float(i % 5) - 2}, 0.2f);
        return s;
    }

    /// From above, within the volumes, orthographic, from below.
    inline static const scene::Camera cameras[]
        = {{.eye = {4, 4, 6}, .target = {0, 0.5f, 0}}, {.eye = {0.5f, 0.6f, 0.5f}, .target = {3, 0.2f, -1}},
            {.eye = {0, 6, 1}, .target = {0, 0, 0}, .half_height = 3}, {.eye = {1, -3, 2}, .target = {0, 0, 0}}};
    static constexpr const char* lights[] = {"sun,elevation=50,azimuth=20,angle=0", "sun,elevation=8,azimuth=200,angle=0",
        "point,position=1/2.5/1,radius=0", "point,position=0/0.3/0,radius=0", "spot,position=5/6/2,target=0/0/0,cone=50,radius=0",
        "spot,position=0/1/0,target=2/0/1,cone=150,radius=0", "sun,direction=-4/-3/-6,angle=0"};
};

constexpr VolumeCulling casters{.casters = true, .max = false, .clamp = false};
constexpr VolumeCulling most{.casters = false, .max = true, .clamp = false};
constexpr VolumeCulling clamped{.casters = false, .max = false, .clamp = true};
constexpr VolumeCulling all{};

TEST_F(VolumeCullingTest, NoPixelLosesItsShadow)
{
    size_t dark = 0, culled = 0, bands = 0;
    for (uint32_t seed = 0; seed < 28; ++seed) {
        const scene::Scene s = crowd(seed, 80);
        const scene::View view = scene::make_view(cameras[seed % 4], picture, s.bounds());
        const char* text = lights[seed % 7];
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        for (const VolumeCulling& by : {casters, most, clamped, all, VolumeCulling{.casters = false, .bands = 32}}) {
            const Result r = cull(s, view, light, by);
            const Loss loss = losses(s, cameras[seed % 4], light, r, !by.casters);
            EXPECT_EQ(loss.lost, 0u) << text << ", seed " << seed << ", casters " << by.casters << ", max " << by.max << ", clamp "
                                     << by.clamp;
            dark += loss.dark, culled += r.casters_culled, bands += r.bands_culled;
            EXPECT_EQ(r.casters_culled, size_t(std::count(r.slots.begin(), r.slots.end(), 0u)));
        }
    }
    EXPECT_GT(dark, 20000u);
    EXPECT_GT(culled, 28u * 5 * 10);
    EXPECT_GT(bands, 28u * 3 * 80 * 4);
}

TEST_F(VolumeCullingTest, FloorsHideWhatTheyShould)
{
    constexpr int each = 30;
    const scene::Scene s = two_floors(each);
    const auto left = [&](const Result& r, int from, int to) {
        int count = 0;
        for (int i = 2 + from; i < 2 + to; ++i) count += r.slots[size_t(i)] != 0;
        return count;
    };
    for (const char* text :
        {"sun,elevation=70,azimuth=30,angle=0", "point,position=0/7/0,radius=0", "spot,position=1/7/1,target=0/0/0,cone=100"}) {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        // from above the upper floor alone is seen: no receiver lies behind what is below it
        const scene::View above = scene::make_view(gpu::camera_above({0, 2, 0}, 4, 3), picture, s.bounds());
        for (const VolumeCulling& by : {casters, most, clamped, all}) {
            const Result r = cull(s, above, light, by);
            EXPECT_EQ(left(r, 0, 2 * each), 0) << text;
            EXPECT_GE(left(r, 2 * each, 3 * each), each * 2 / 3) << text;
        }
        // between the floors all is dark by the upper one, whatever else stands before it
        const scene::View between = scene::make_view({.eye = {0, 1.6f, 1}, .target = {0, 0, 0}}, picture, s.bounds());
        EXPECT_GE(left(cull(s, between, light, most), each, 2 * each), each / 4) << text;
        const Result r = cull(s, between, light, casters);
        EXPECT_LE(left(r, each, 2 * each), each / 5) << text << ": but for what lies under the floor's diagonal";
        EXPECT_EQ(left(r, 0, each), 0);
        EXPECT_NE(r.slots[1], 0u) << "the upper floor";
    }
}

TEST_F(VolumeCullingTest, BandsFollowTheLight)
{
    const scene::Scene s = gpu::floor_scene(4);
    const scene::View view = scene::make_view({.eye = {0, 3, 8}, .target = {0, 0, 0}}, {96, 64}, s.bounds());
    const auto bands = [&](const char* light) { return shadow::parts::volume_bands(view, scene::parse_light(light, {}, s.bounds()), 8); };
    // planes are those of columns where the light shines to the side, of rows where it shines down; borders are whole pixels
    const auto pixel = [&](const vec4& plane, int axis, float at) {
        vec2 xy(10.5f, 10.5f);
        xy[axis] = at;
        const scene::Ray ray = scene::view_ray(view, xy);
        const vec4 p(ray.origin + 5.0f * ray.direction, 1);
        return glm::dot(plane, p);
    };
    for (const auto& [light, axis] : {std::pair{"sun,direction=1/-0.2/0,angle=0", 0}, {"sun,direction=0/-1/-0.1,angle=0", 1},
             {"point,position=9/0/0,radius=0", 0}, {"point,position=0/9/0,radius=0", 1}}) {
        const shaders::VolumeBands b = bands(light);
        ASSERT_EQ(b.count, 8u);
        const int size = axis == 0 ? 96 : 64;
        for (uint32_t i = 1; i < b.count; ++i) {
            const float border = float(size) * float(i) / 8;
            EXPECT_GT(pixel(b.planes[i], axis, border + 0.01f), 0) << light;
            EXPECT_LT(pixel(b.planes[i], axis, border - 0.01f), 0) << light;
        }
    }
    const scene::View tiny = scene::make_view({.eye = {0, 3, 8}, .target = {0, 0, 0}}, {1, 1}, s.bounds());
    const scene::Light sun = scene::parse_light("sun", {}, s.bounds());
    EXPECT_EQ(shadow::parts::volume_bands(tiny, sun, 16).count, 1u);
    EXPECT_EQ(shadow::parts::volume_bands(view, sun, 1000).count, 32u);
    EXPECT_EQ(cull(s, tiny, sun, all).slots.size(), 1u);
    scene::Scene empty;
    empty.materials.emplace_back();
    const scene::Camera ahead{.eye = {0, 0, 3}, .target = {0, 0, 0}};
    for (const double way : {0., 1., 4.})
        EXPECT_EQ(mean(TechniqueTest::draw(technique_shadow_volumes, empty, ahead, picture, "sun,elevation=40", {{"culling", way}})), 1);
}

/// none, casters, max, clamp, all
constexpr double ways[] = {0, 1, 2, 3, 4};

TEST_F(VolumeCullingTest, NoBitOfThePictureChanges)
{
    double dark = 0;
    for (uint32_t seed = 0; seed < 28; ++seed) {
        const scene::Scene s = crowd(100 + seed, 60);
        for (const Values& values : {Values{{"counter", 2}}, Values{{"counter", 1}}, Values{{"log_alpha", 1}, {"edges", 1}}}) {
            const auto with = [&](double way, double bands) {
                Values all_values = values;
                all_values.insert(all_values.end(), {{"culling", way}, {"bands", bands}});
                return TechniqueTest::draw(technique_shadow_volumes, s, cameras[seed % 4], picture, lights[seed % 7], all_values);
            };
            const std::vector<float> whole = with(0, 16);
            dark += 1 - mean(whole);
            for (const double way : ways) {
                const std::vector<float> got = with(way, 3 + seed);
                size_t changed = 0, lighter = 0;
                for (size_t i = 0; i < got.size(); ++i) changed += got[i] != whole[i], lighter += got[i] > whole[i];
                EXPECT_EQ(changed, 0u) << lights[seed % 7] << ", seed " << seed << ", " << values[0].first << ", way " << way
                                       << ", lighter " << lighter;
            }
        }
    }
    EXPECT_GT(dark, 3.0);
}

TEST_F(VolumeCullingTest, LessIsCountedInScenes)
{
    const char* given = std::getenv("GNOMON_SHARED");
    const std::filesystem::path shared = given ? given : GNOMON_SOURCE "/../shared";
    struct Case {
        std::string scene;
        double updates; ///< of those without culling, at most
    };
    std::vector<Case> cases = {{"citadel", 0.9}, {"colonnade", 0.65}};
    if (const auto file = shared / "scenes/candela_city.glb"; std::filesystem::exists(file)) cases.push_back({file.string(), 0.7});
    for (const Case& c : cases) {
        const scene::Scene s = scene::load(c.scene);
        const scene::Camera camera = s.cameras.empty() ? scene::fit_camera(s.bounds()) : s.cameras[0];
        std::vector<uint64_t> updates;
        std::vector<float> first;
        for (const double way : ways) {
            const char* sun = "sun,elevation=42,azimuth=130,angle=0";
            const Values values{{"culling", way}};
            updates.push_back(count(technique_shadow_volumes, s, camera, picture, sun, values).at("stencil_updates"));
            const std::vector<float> got = TechniqueTest::draw(technique_shadow_volumes, s, camera, picture, sun, values);
            if (first.empty()) first = got;
            EXPECT_EQ(got, first) << c.scene << ", " << way;
        }
        RecordProperty(std::filesystem::path(c.scene).stem().string(),
            std::to_string(updates[0]) + " " + std::to_string(updates[1]) + " " + std::to_string(updates[2]) + " "
                + std::to_string(updates[3]) + " " + std::to_string(updates[4]));
        for (const size_t way : {1, 2, 3}) {
            EXPECT_LE(updates[way], updates[0]) << c.scene;
            EXPECT_LE(updates[4], updates[way]) << c.scene;
        }
        EXPECT_LE(double(updates[4]), c.updates * double(updates[0]))
            << c.scene << ": " << updates[0] << " " << updates[1] << " " << updates[2] << " " << updates[3] << " " << updates[4];
    }
}

} // namespace
} // namespace gnomon
