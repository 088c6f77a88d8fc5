// SPDX-License-Identifier: Apache-2.0
#include "lab/render.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

/// Khronos PBR Neutral tone mapper (2024): leaves base colours below 0.8 as they are, compresses above, desaturates the brightest.
vec3 pbr_neutral(vec3 c)
{
    constexpr float start = 0.8f - 0.04f, desaturation = 0.15f;
    const float x = std::min({c.x, c.y, c.z});
    const float offset = x < 0.08f ? x - 6.25f * x * x : 0.04f;
    c -= offset;
    const float peak = std::max({c.x, c.y, c.z});
    if (peak < start) return c;
    const float d = 1.0f - start, new_peak = 1.0f - d * d / (peak + d - start);
    c *= new_peak / peak;
    const float g = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
    return glm::mix(c, vec3(new_peak), g);
}

} // namespace

base::Picture display(const base::Picture& radiance, const Stage& stage, float stops)
{
    // a white diffuse surface under irradiance E has radiance E / pi
    const float exposure = pi / shadow::reference_irradiance(stage.lights, stage.bounds) * std::exp2(stops) * 1.25f;
    base::Picture out(radiance.size, 3);
    for (size_t i = 0; i < radiance.size.area(); ++i) {
        const vec3 c = pbr_neutral(exposure * vec3(radiance.values[i * 3], radiance.values[i * 3 + 1], radiance.values[i * 3 + 2]));
        for (int k = 0; k < 3; ++k) out.values[i * 3 + size_t(k)] = std::clamp(c[k], 0.0f, 1.0f);
    }
    return out;
}

} // namespace gnomon::lab
