// SPDX-License-Identifier: Apache-2.0
// The suite of exact techniques (exact_suite.h); each technique's own test file says with which parameters it takes it.
#include "exact_suite.h"
#include "naive_containment.h"

#include <limits>

namespace gnomon {

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExactSoups);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExactPlaces);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExactBadInput);

TEST_P(ExactSoups, HaveNoWrongPixel)
{
    const char* lights[] = {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/2.5/1,radius=0",
        "spot,position=5/6/2,target=0/0/0,cone=50,radius=0", "sun,elevation=12,azimuth=200,angle=0", "point,position=-1/9/2,radius=0"};
    const scene::Camera plan{.eye = {1, 7, 2}, .target = {0, 0.5f, 0}, .half_height = 3};
    for (uint32_t k = 0; k < GetParam().soups && !HasFailure(); ++k) {
        const uint32_t seed = GetParam().first_soup + k;
        SCOPED_TRACE(fmt::format("soup {}", seed));
        expect_right(GetParam(), soup(seed, 40 + int(seed % 3) * 60), seed % 7 == 3 ? plan : oblique, {64, 48}, lights[seed % 5], 20, 20);
    }
}

/// With the point from depth, a quarter of HardTruth's margin is left to rounding and to the techniques' offsets.
TEST_P(ExactSoups, AgreeWithContainmentInEveryVolume)
{
    constexpr double band = 1e-4;
    const gpu::Size size{64, 48};
    for (const uint32_t seed : {201u, 202u, 203u, 204u, 205u, 206u}) {
        const scene::Scene s = soup(seed, 120);
        const std::string text = seed % 2 ? "sun,elevation=40,azimuth=70,angle=0" : "point,position=0.4/2.6/0.8,radius=0";
        const HardTruth truth(s, scene::parse_light(text, {}, s.bounds()));
        const NaiveContainment oracle(truth, scene::make_view(oblique, size, s.bounds()));
        const std::vector<Seen> seen = receivers(truth, s, oblique, size);
        const std::vector<float> got = draw(GetParam(), s, oblique, size, text);
        size_t wrong = 0, dark = 0, lit = 0;
        for (size_t i = 0; i < got.size(); ++i) {
            if (seen[i].own == SIZE_MAX) continue;
            const double facing = glm::dot(seen[i].n, glm::normalize(truth.to_light(seen[i].p)));
            const double inside = facing < 0 ? 1 : oracle.depth_inside(oracle.point(i, seen[i].depth), seen[i].own);
            if (std::abs(facing) < 1e-3 || std::abs(inside) < band) continue;
            wrong += got[i] != (inside > 0 ? 0.0f : 1.0f);
            ++(inside > 0 ? dark : lit);
        }
        EXPECT_EQ(wrong, 0u) << seed;
        EXPECT_GT(dark, 100u);
        EXPECT_GT(lit, 200u);
        EXPECT_GT(
            double(dark + lit), 0.98 * double(std::count_if(seen.begin(), seen.end(), [](const Seen& p) { return p.own != SIZE_MAX; })));
    }
}

TEST_P(ExactPlaces, HaveNoWrongPixel)
{
    const gpu::Size size{96, 64};
    for (const ExactCase& c : special_places()) {
        SCOPED_TRACE(c.name);
        const Count n = compare(expect_sane(GetParam(), c, size), c.scene, c.camera, size, c.light);
        EXPECT_EQ(n.wrong, 0u);
        EXPECT_LT(double(n.unknown), c.most_unknown * double(size.area()));
    }
}

TEST_P(ExactBadInput, BadTrianglesCastWhatIsLeftOfThem)
{
    const gpu::Size size{96, 64};
    for (const ExactCase& c : bad_triangles()) {
        SCOPED_TRACE(c.name);
        const Count n = compare(expect_sane(GetParam(), c, size), c.scene, c.camera, size, c.light, c.scale);
        EXPECT_EQ(n.wrong, 0u);
        EXPECT_LT(double(n.unknown), c.most_unknown * double(size.area()));
    }
}

TEST_P(ExactBadInput, ClosedShapesDoNotLeak)
{
    const gpu::Size size{160, 120};
    for (const ExactCase& c : closed_shapes()) {
        const HardTruth truth(c.scene, scene::parse_light(c.light, {}, c.scene.bounds()));
        const std::vector<float> got = expect_sane(GetParam(), c, size);
        const std::vector<Seen> seen = receivers(truth, c.scene, c.camera, size);
        size_t leaks = 0, judged = 0;
        for (size_t i = 0; i < got.size(); ++i) {
            // Nearer to a crease than this the point, which comes from depth, may lie behind the next triangle.
            if (!(seen[i].to_edge > 1e-4)) continue;
            leaks += got[i] != 0.0f;
            ++judged;
        }
        EXPECT_EQ(leaks, 0u) << c.name;
        EXPECT_GT(double(judged), 0.98 * double(size.area())) << c.name;
    }
}

TEST_P(ExactBadInput, LostPrecisionGivesAnAnswer)
{
    for (const ExactCase& c : lost_precision()) expect_sane(GetParam(), c, {96, 64});
}

namespace {

std::string point_at(vec3 p) { return fmt::format("point,position={:.9g}/{:.9g}/{:.9g},radius=0", p.x, p.y, p.z); }
std::string sun_along(vec3 d) { return fmt::format("sun,direction={:.9g}/{:.9g}/{:.9g},angle=0", d.x, d.y, d.z); }

mat4 placed(vec3 centre, float size) { return glm::scale(glm::translate(mat4(1), centre), vec3(size)); }

/// A material that is not seen from behind, although it casts.
void single_sided(scene::Scene& s)
{
    s.materials.emplace_back();
    s.meshes.back().material = int(s.materials.size()) - 1;
}

/// The scene, its camera and its light's place times a power of two: every number keeps its digits.
ExactCase scaled(ExactCase c, vec3 light, float by)
{
    for (scene::Mesh& m : c.scene.meshes) {
        for (vec3& p : m.positions) p *= by;
        m.bounds = {m.bounds.min * by, m.bounds.max * by};
    }
    for (scene::Instance& i : c.scene.instances) i.world_from_object[3] = vec4(vec3(i.world_from_object[3]) * by, 1);
    c.camera.eye *= by, c.camera.target *= by;
    c.light = point_at(light * by);
    c.scale *= double(by);
    return c;
}

} // namespace

std::vector<ExactCase> special_places()
{
    const scene::Scene s = soup(7, 100);
    const char* sun = "sun,elevation=50,azimuth=20,angle=0";
    std::vector<ExactCase> out;
    const auto add = [&](const char* name, const scene::Scene& scene, const scene::Camera& camera, const std::string& light) {
        out.push_back({name, scene, camera, light});
    };
    const scene::Camera flat{.eye = {4, 4, 6}, .target = {0, 0.5f, 0}, .half_height = 2.5f};

    scene::Scene shaded = s;
    const scene::Light parsed = scene::parse_light(sun, {}, s.bounds());
    const vec3 to_sun = -std::get<scene::DirectionalLight>(parsed.shape).direction;
    gpu::add_quad(shaded, oblique.eye + 0.7f * to_sun, 0.8f);
    add("the eye in shadow", shaded, oblique, sun);
    shaded.meshes.pop_back(), shaded.instances.pop_back();
    add_mesh(shaded, box(), placed(oblique.eye, 0.4f));
    single_sided(shaded);
    add("the eye inside a caster", shaded, oblique, sun);
    add("the light inside a caster", shaded, flat, point_at(oblique.eye + vec3(0.1f, 0.05f, -0.02f)));
    scene::Scene clipped = s;
    const vec3 forward = glm::normalize(oblique.target - oblique.eye);
    scene::Camera near = oblique;
    near.near = 0.2f;
    for (const float distance : {0.1f, 0.2f, 0.3f}) {
        const mat4 tilt = glm::rotate(glm::translate(mat4(1), oblique.eye + distance * forward), 0.9f, vec3(0.3f, 0.5f, 0.8f));
        scene::Mesh card;
        card.positions = {{-0.05f, -0.05f, 0.05f}, {0.05f, -0.05f, 0.04f}, {0, 0.05f, -0.05f}}, card.indices = {0, 1, 2};
        add_mesh(clipped, card, tilt);
    }
    add("casters before, at and behind the near plane", clipped, near, point_at(oblique.eye - 0.4f * forward + vec3(0, 0.1f, 0)));

    add("the light at the eye", s, oblique, point_at(oblique.eye));
    add("the light behind the camera", s, oblique, point_at(oblique.eye - 2.0f * forward));
    add("the light in the picture plane, beside the eye", s, oblique, point_at(oblique.eye + glm::cross(forward, vec3(0, 1, 0))));
    add("the light just beside the eye", s, oblique, "point,position=4.3/5/5,radius=0");
    add("the light in the picture", s, oblique, "point,position=0/0.7/0,radius=0");
    add("the light a millimetre above the floor", s, oblique, "point,position=0/0.001/0,radius=0");
    add("a spot down the view's axis", s, oblique, "spot,position=8/7.5/12,target=0/0.5/0,cone=40,radius=0");
    add("the sun down the view's axis", s, oblique, sun_along(forward));
    add("looking into the sun", s, oblique, "sun,direction=4/-0.5/6,angle=0");
    add("the sun overhead", s, oblique, "sun,elevation=90,angle=0");
    add("the sun almost set", s, oblique, "sun,elevation=0.5,azimuth=30,angle=0");

    add("orthographic, the sun", s, flat, sun);
    add("orthographic, the sun down the axis", s, flat, sun_along(forward));
    add("orthographic, the sun across the axis", s, flat, sun_along(glm::cross(forward, glm::normalize(vec3(1, -0.4f, -1)))));
    add("orthographic, a light in the picture", s, flat, "point,position=0.5/1.5/0.3,radius=0");
    add("orthographic, a light behind", s, flat, point_at(oblique.eye - 2.0f * forward));

    const std::vector<vec3>& p = s.meshes[1].positions;
    add("the light on a corner", s, oblique, point_at(p[3]));
    add("the light on another corner", s, oblique, point_at(p[40]));
    add("the light on an edge", s, oblique, point_at(0.5f * (p[9] + p[10])));
    add("the light in a triangle", s, oblique, point_at((p[15] + p[16] + p[17]) / 3.0f));
    add("the light in a triangle's plane", s, oblique, point_at(2.0f * p[18] - p[19] + 0.5f * (p[20] - p[18])));
    add("the sun along an edge", s, oblique, sun_along(p[21].y > p[22].y ? p[22] - p[21] : p[21] - p[22]));
    const vec3 across = p[24] + p[25] - 2.0f * p[26];
    add("the sun in a triangle's plane", s, oblique, sun_along(across.y < 0 ? across : -across));
    return out;
}

std::vector<ExactCase> bad_triangles()
{
    std::vector<ExactCase> out;
    const auto add = [&](const char* name, const scene::Scene& s) {
        for (const char* light : {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/3.5/1,radius=0"})
            out.push_back({fmt::format("{} under a {:.5}", name, light), s, oblique, light});
    };
    const auto with = [](std::vector<vec3> positions, std::vector<uint32_t> indices) {
        scene::Scene s = soup(2, 40);
        scene::Mesh m;
        m.positions = std::move(positions), m.indices = std::move(indices);
        add_mesh(s, m);
        return s;
    };
    const vec3 a(-1.5f, 1.8f, -1), b(1.5f, 2.2f, 0.5f), c(0.25f, 1.5f, 2), d(0.5f, 3, -2);
    // Each stands beside, and shares corners with, a triangle that is well.
    add("one corner three times", with({a, b, c}, {0, 1, 2, 1, 1, 1}));
    add("one corner twice", with({a, b, c}, {0, 1, 2, 1, 1, 2, 2, 0, 2}));
    add("corners on a line", with({a, b, c, 0.25f * a + 0.75f * b}, {0, 1, 2, 0, 3, 1, 0, 1, 3}));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    add("a corner that is not a number", with({a, b, c, {nan, 1, 0}}, {0, 1, 2, 0, 2, 3, 1, 0, 3}));
    add("three of them", with({a, b, c, vec3(nan)}, {0, 1, 2, 3, 3, 3}));
    add("the same triangle three times", with({a, b, c, d}, {0, 1, 2, 0, 1, 2, 1, 2, 0, 0, 3, 1}));
    add("opposite faces in one place", with({a, b, c, d}, {0, 1, 2, 0, 2, 1, 0, 3, 1, 3, 0, 1}));
    std::vector<vec3> fan{a, b};
    std::vector<uint32_t> blades;
    for (uint32_t k = 0; k < 7; ++k) {
        const float angle = 0.4f + 0.9f * float(k);
        fan.push_back(0.5f * (a + b) + vec3(-0.4f * std::sin(angle), std::cos(angle), std::sin(angle)));
        blades.insert(blades.end(), {k % 2, 1 - k % 2, 2 + k});
    }
    add("seven faces at an edge", with(fan, blades));

    const vec3 light(1, 3.5f, 1);
    const ExactCase plain{"a plain scene", soup(4, 60), oblique, point_at(light)};
    for (const float by : {0x1p-20f, 0x1p20f}) {
        out.push_back(scaled(plain, light, by));
        out.back().name = fmt::format("{} times {:g}", plain.name, by);
    }
    return out;
}

std::vector<ExactCase> closed_shapes()
{
    std::vector<ExactCase> out;
    const std::string outside[] = {"sun,elevation=35,azimuth=20,angle=0", point_at({3, 2.5f, 1}), point_at({0.1f, 40, 0.2f})};
    const scene::Camera inside{.eye = {0.1f, 0.05f, -0.2f}, .target = {0.6f, -0.3f, 0.4f}, .fov_y = 1.8f};
    for (uint32_t seed = 0; seed < 6; ++seed) {
        scene::Scene s = floor_scene(40);
        for (scene::Instance& i : s.instances) i.world_from_object[3].y = -1.2f;
        const mat4 turned = glm::rotate(mat4(1), 0.4f * float(seed), glm::normalize(vec3(0.3f, 1, 0.2f)));
        if (seed == 0)
            add_mesh(s, box(), turned);
        else
            for (const scene::Mesh& half : closed_shape(seed)) add_mesh(s, half, turned);
        for (const std::string& light : outside) out.push_back({fmt::format("shape {} from inside, {}", seed, light), s, inside, light});
        // The picture shows the floor and the shape's outside alone.
        const scene::Camera above{.eye = {1.5f, 3, 2}, .target = {0, -0.5f, 0}, .fov_y = 0.9f};
        out.push_back({fmt::format("a light in shape {}", seed), s, above, point_at({0.1f, 0.15f, -0.05f})});
    }
    return out;
}

std::vector<ExactCase> lost_precision()
{
    std::vector<ExactCase> out;
    const vec3 far(1e6f, -2e6f, 1e6f), light(1, 3.5f, 1);
    ExactCase moved{"a million metres from the origin", soup(4, 60), oblique, point_at(light + far)};
    for (scene::Instance& i : moved.scene.instances) i.world_from_object[3] += vec4(far, 0);
    moved.camera.eye += far, moved.camera.target += far;
    out.push_back(moved);
    ExactCase vast{"triangles of a million metres", soup(4, 60), oblique, point_at(light)};
    gpu::add_quad(vast.scene, {-1e6f, 3, 0}, 1e6f);
    vast.scene.meshes[1].positions[0] *= 1e6f;
    vast.scene.meshes[1].bounds.add(vast.scene.meshes[1].positions[0]);
    out.push_back(vast);
    return out;
}

} // namespace gnomon
