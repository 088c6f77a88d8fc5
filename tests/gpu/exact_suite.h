// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exact_scenes.h"
#include "hard_truth.h"

#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <ostream>

// What every technique of exact hard shadows must do, whatever it does it with. A technique takes the suite by naming itself and its
// parameters (tests/gpu/exact_suite_test.cpp):
//
//   INSTANTIATE_TEST_SUITE_P(alias_free, ExactSoups, testing::Values(ExactSubject{technique_alias_free, "grid_64", {{"grid", 64}}}),
//       exact_name);
namespace gnomon {

struct ExactSubject {
    const shadow::TechniqueInfo& technique;
    std::string name; ///< of these values: letters, digits and underscores
    std::vector<std::pair<const char*, double>> values;
    uint32_t first_soup = 0, soups = 50; ///< seeds of random scenes
};
inline std::ostream& operator<<(std::ostream& out, const ExactSubject& s) { return out << s.technique.id << " " << s.name; }
inline std::string exact_name(const testing::TestParamInfo<ExactSubject>& info) { return info.param.name; }

class ExactTest : public gpu::TechniqueTest {
protected:
    using gpu::TechniqueTest::draw;
    struct Count {
        size_t wrong = 0, unknown = 0, dark = 0, lit = 0;
    };

    /// Red of each pixel: of techniques whose parameters make them write colours too.
    static std::vector<float> draw(
        const ExactSubject& t, const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const std::string& light)
    {
        std::vector<float> out = TechniqueTest::draw(t.technique, s, camera, size, light.c_str(), t.values);
        if (out.size() == size_t(size.area()) * 4)
            for (size_t i = 0; i < size_t(size.area()); ++i) out[i] = out[4 * i];
        out.resize(size_t(size.area()));
        return out;
    }
    /// Of each pixel, as drawn.
    struct Surface {
        std::vector<float> primitive, depth;
    };
    static Surface surface(const scene::Scene& s, const scene::View& view)
    {
        shadow::SceneGpu scene(device(), s);
        gpu::Image primitive = image("primitive", VK_FORMAT_R32_UINT, view.size), depth = image("depth", VK_FORMAT_D32_SFLOAT, view.size);
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        passes.copy(g.primitive, passes.import(primitive));
        passes.copy(g.depth, passes.import(depth));
        device().submit(std::move(passes));
        return {device().read_back(primitive).values, device().read_back(depth).values};
    }

    /// The very point of a triangle that a pixel shows.
    struct Seen {
        size_t own = SIZE_MAX; ///< its triangle; SIZE_MAX = background
        dvec3 p{0}, n{0}; ///< n: unit, on the eye's side
        double facing = 0; ///< cosine to the eye
        float depth = 0; ///< as drawn
        double to_edge = 0; ///< metres to the triangle's nearest edge
    };
    static std::vector<Seen> receivers(const HardTruth& truth, const scene::Scene& s, const scene::Camera& camera, gpu::Size size)
    {
        const scene::View view = scene::make_view(camera, size, s.bounds());
        const Surface drawn = surface(s, view);
        const std::vector<float>& ids = drawn.primitive;
        std::vector<Seen> out(ids.size());
        for (size_t i = 0; i < ids.size(); ++i) {
            if (ids[i] >= 4294967040.0f) continue;
            Seen& seen = out[i];
            seen.own = size_t(ids[i]);
            seen.depth = drawn.depth[i];
            const Triangle& t = truth.triangles()[seen.own];
            const size_t column = i % size_t(size.width), row = i / size_t(size.width);
            const scene::Ray ray = scene::view_ray(view, vec2(float(column), float(row)) + 0.5f);
            const dvec3 along(ray.direction), n = glm::normalize(HardTruth::normal(t));
            seen.p = dvec3(ray.origin) + glm::dot(n, t[0] - dvec3(ray.origin)) / glm::dot(n, along) * along;
            seen.facing = std::abs(glm::dot(n, along));
            seen.n = glm::dot(n, along) > 0 ? -n : n;
            seen.to_edge = std::numeric_limits<double>::infinity();
            for (size_t k = 0; k < 3; ++k) {
                const dvec3 edge = t[(k + 1) % 3] - t[k];
                seen.to_edge = std::min(seen.to_edge, glm::length(glm::cross(seen.p - t[k], edge)) / glm::length(edge));
            }
        }
        return out;
    }

    /// What was drawn against HardTruth.
    static Count compare(const std::vector<float>& got, const scene::Scene& s, const scene::Camera& camera, gpu::Size size,
        const std::string& text, double scale = 1)
    {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const HardTruth truth(s, light, scale);
        const std::vector<Seen> seen = receivers(truth, s, camera, size);
        Count count;
        for (size_t i = 0; i < got.size(); ++i) {
            if (seen[i].own == SIZE_MAX) {
                count.wrong += got[i] != 1.0f;
                continue;
            }
            const Verdict verdict = seen[i].facing >= 0.05 ? truth.at(seen[i].p, seen[i].n, seen[i].own) : Verdict::unknown;
            count.unknown += verdict == Verdict::unknown;
            count.dark += verdict == Verdict::dark;
            count.lit += verdict == Verdict::lit;
            count.wrong += (verdict == Verdict::dark && got[i] != 0.0f) || (verdict == Verdict::lit && got[i] != 1.0f);
        }
        return count;
    }
    static Count compare(
        const ExactSubject& t, const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const std::string& light)
    {
        return compare(draw(t, s, camera, size, light), s, camera, size, light);
    }

    /// No pixel wrong, and enough of them known.
    static void expect_right(const ExactSubject& t, const scene::Scene& s, const scene::Camera& camera, gpu::Size size,
        const std::string& light, size_t least_dark = 100, size_t least_lit = 100, double most_unknown = 0.04)
    {
        const Count c = compare(t, s, camera, size, light);
        EXPECT_EQ(c.wrong, 0u) << light << " of " << size.area();
        EXPECT_LT(double(c.unknown), most_unknown * double(size.area())) << light;
        EXPECT_GE(c.dark, least_dark) << light;
        EXPECT_GE(c.lit, least_lit) << light;
    }

    /// Drawn twice: the same bits, all of them 0 or 1.
    static std::vector<float> expect_sane(const ExactSubject& t, const ExactCase& c, gpu::Size size)
    {
        std::vector<float> once = draw(t, c.scene, c.camera, size, c.light);
        size_t odd = 0;
        for (const float v : once) odd += v != 0.0f && v != 1.0f;
        EXPECT_EQ(odd, 0u) << c.name << ": neither 0 nor 1";
        EXPECT_TRUE(once == draw(t, c.scene, c.camera, size, c.light)) << c.name << ": other bits the second time";
        return once;
    }
};

class ExactSuite : public ExactTest, public testing::WithParamInterface<ExactSubject> { };
/// Random triangles under lights of all kinds.
class ExactSoups : public ExactSuite { };
/// Cameras and lights in special places.
class ExactPlaces : public ExactSuite { };
/// Bad triangles, closed shapes and coordinates of all sizes.
class ExactBadInput : public ExactSuite { };

} // namespace gnomon
