// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/technique.h"

#include <span>

namespace gnomon::shadow {

/// A light with the image that a technique (or the truth) made for it.
struct ShadowedLight {
    const scene::Light* light;
    gpu::ImageId image; ///< visibility or transmittance; invalid = unshadowed
};

/// Light from everywhere, so that shadowed parts can be read: a hemisphere of two colours about +Y, radiance.
struct Ambient {
    vec3 sky{0.38f, 0.47f, 0.62f}, ground{0.20f, 0.18f, 0.16f};
};

struct LightingSettings {
    float ambient = 0.45f; ///< scales Ambient, relative to the lights
};

/// The largest irradiance that one of the lights gives at normal incidence at the scene's centre: what exposure and ambient are
/// relative to. 1 where there is no light.
float reference_irradiance(std::span<const scene::Light>, const Bounds&);

/// Deferred lighting: Lambert diffuse + GGX specular (Walter et al. 2007, Smith height-correlated after Heitz 2014), metallic-roughness
/// as in glTF 2.0 appendix B; each light at its centre, times its image. Then emission, sky where there is no surface, and the
/// blended surfaces, sorted, under unshadowed light. Returns RGBA32F scene-referred linear radiance.
gpu::ImageId shade(gpu::PassList&, SceneGpu&, const GBuffer&, const scene::View&, std::span<const ShadowedLight>, const LightingSettings&);

} // namespace gnomon::shadow
