// SPDX-License-Identifier: Apache-2.0
// A picture drawn in parts is the picture.
#include "lab/render.h"
#include "reliability.h"
#include "tests/gpu/device_fixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::tests {
namespace {

class Tiles : public gpu::DeviceTest, public testing::WithParamInterface<const char*> {
protected:
    static lab::Rendered draw(const lab::Stage& stage, int tile)
    {
        shadow::SceneGpu scene(device(), stage.scene);
        return lab::render(
            device(), scene, stage, lab::parse_choice(GetParam()), {.tile = tile, .aovs = {"depth", "position", "primitive"}});
    }
    static lab::Stage stage(const char* camera)
    {
        return lab::open_stage({.scene = "contact",
            .load = {.detail = 0.2},
            .camera = camera,
            .lights = {"sun,elevation=50,azimuth=35,angle=0"},
            .size = {200, 136}});
    }
};

/// Whether anything changes within a pixel's distance: the rim of a triangle or of a shadow.
bool at_rim(const lab::Rendered& r, int x, int y)
{
    const base::Picture& light = r.images.front();
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int nx = std::clamp(x + dx, 0, light.size.width - 1), ny = std::clamp(y + dy, 0, light.size.height - 1);
            const size_t here = size_t(y) * size_t(light.size.width) + size_t(x),
                         there = size_t(ny) * size_t(light.size.width) + size_t(nx);
            if (r.primitive[here] != r.primitive[there] || light.values[here] != light.values[there]) return true;
        }
    return false;
}

/// A part's matrices are other floats than the whole's, and lavapipe snaps corners to 1/256 of a pixel: now and then a rim moves by that.
TEST_P(Tiles, OfAnExactTechniqueHaveTheBitsOfTheWholeButOnRims)
{
    for (const char* camera : {"", "eye=4/5/6,target=0/0.5/0,ortho=3"}) {
        SCOPED_TRACE(camera);
        const lab::Stage s = stage(camera);
        const lab::Rendered whole = draw(s, 4096), parts = draw(s, 48); // 5 x 3, the last of a row and a column narrower
        ASSERT_EQ(parts.radiance.size, whole.radiance.size);
        size_t rims = 0, off_rims = 0, inside = 0, far = 0;
        for (int y = 0; y < whole.radiance.size.height; ++y)
            for (int x = 0; x < whole.radiance.size.width; ++x) {
                const size_t i = size_t(y) * size_t(whole.radiance.size.width) + size_t(x);
                const bool same
                    = parts.primitive[i] == whole.primitive[i] && parts.images.front().values[i] == whole.images.front().values[i];
                const bool rim = at_rim(whole, x, y);
                rims += rim, off_rims += rim && !same, inside += !rim && !same;
                if (!same) continue;
                // A corner that moved by 1/256 of a pixel tilts its triangle by as much.
                for (const char* aov : {"depth", "position"})
                    for (int c = 0; c < whole.aovs.at(aov).channels; ++c)
                        far += !(std::abs(parts.aovs.at(aov).at(x, y, c) - whole.aovs.at(aov).at(x, y, c)) < 5e-3f);
                for (int c = 0; c < 3; ++c) far += !(std::abs(parts.radiance.at(x, y, c) - whole.radiance.at(x, y, c)) < 1e-2f);
            }
        EXPECT_EQ(inside, 0u);
        EXPECT_EQ(far, 0u);
        EXPECT_LE(off_rims, rims / 200) << "of " << rims;
        record("limits",
            {{"limit", fmt::format("tiles against the whole, {}, {}", GetParam(), *camera ? "orthographic" : "perspective")},
                {"outcome", fmt::format("{} of {} pixels differ, all on rims ({})", off_rims, whole.primitive.size(), rims)}});
    }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Tiles, testing::Values("ray_traced", "shadow_volumes", "per_triangle_volumes"),
    [](const auto& p) { return std::string(p.param); });

} // namespace
} // namespace gnomon::tests
