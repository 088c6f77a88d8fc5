// SPDX-License-Identifier: Apache-2.0
// A layer's depths as the series takes them: from -1 at the nearest to 1 at the far plane, where also lies whatever was not drawn. The
// near plane is often far from what it guards: a light inside the scene has it at its centre. Depths that fill more of the wave tell
// blockers from receivers that are nearer to each other.
#ifndef GNOMON_CSSM_DEPTH_GLSL
#define GNOMON_CSSM_DEPTH_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_map.glsl"
#include "techniques/cssm/cssm.shared.h"

// Metres; pyramid: of least and greatest stored depth, all levels.
float first_depth(LightMapLayer layer, sampler2DArray pyramid, int index, bool tight)
{
    if (!tight) return layer.near;
    const float nearest = texelFetch(pyramid, ivec3(0, 0, index), textureQueryLevels(pyramid) - 1).y;
    return min(depth_from_stored(layer, nearest), layer.far - 1e-3 * (layer.far - layer.near)); // of an empty map too
}

float wave_depth(LightMapLayer layer, float first, float depth) { return 2.0 * (depth - first) / (layer.far - first) - 1.0; }

// Of a texel's depth on [-1, 1].
float wave_phase(Series s, float z) { return 3.14159265358979 * s.fill * (0.5 + 0.5 * z); }

#endif
