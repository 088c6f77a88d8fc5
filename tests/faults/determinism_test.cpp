// SPDX-License-Identifier: Apache-2.0
// The same input gives the same bits, ten times over, on a device and on a fresh one.
#include "base/hash.h"
#include "lab/folder.h"
#include "lab/render.h"
#include "reliability.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::tests {
namespace {

class Determinism : public testing::TestWithParam<const shadow::TechniqueInfo*> { };

std::string picture(gpu::Device& device, const shadow::TechniqueInfo& info, const std::string& kind)
{
    const lab::TechniqueScene own = lab::read_technique_scene(lab::project_root() / "techniques" / info.id);
    const lab::Stage stage = lab::technique_stage(own, kind, {96, 64});
    shadow::SceneGpu scene(device, stage.scene);
    const lab::Rendered r = lab::render(device, scene, stage, lab::technique_choice(info, own), {});
    return base::Hasher().array(r.images.front().values).array(r.radiance.values).array(r.primitive).hex();
}

TEST_P(Determinism, TenTimesTheSameBits)
{
    const shadow::TechniqueInfo& info = *GetParam();
    auto device = gpu::Device::open({});
    if (const std::string reason = info.unavailable ? info.unavailable(*device) : ""; !reason.empty()) GTEST_SKIP() << reason;
    size_t pictures = 0, lights = 0;
    for (const std::string& kind : lab::claimed_kinds(info)) {
        if (++lights > 1 && !at_full_length()) break;
        std::set<std::string> seen;
        for (int i = 0; i < 10; ++i, ++pictures) {
            if (i == 5) device.reset(), device = gpu::Device::open({});
            seen.insert(picture(*device, info, kind));
        }
        EXPECT_EQ(seen.size(), 1u) << kind;
    }
    record("determinism", {{"technique", info.id}, {"how", "ten times, two devices"}, {"pictures", pictures}, {"failures", HasFailure()}});
}

/// All of them in a full run; else those whose passes add up in the order in which invocations come: counters, lists, pages.
std::vector<const shadow::TechniqueInfo*> chosen()
{
    if (at_full_length()) return {shadow::techniques().begin(), shadow::techniques().end()};
    return {&shadow::technique("virtual_shadow_map"), &shadow::technique("alias_free")};
}

INSTANTIATE_TEST_SUITE_P(Techniques, Determinism, testing::ValuesIn(chosen()), [](const auto& p) { return std::string(p.param->id); });

} // namespace
} // namespace gnomon::tests
