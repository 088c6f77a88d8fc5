// SPDX-License-Identifier: Apache-2.0
// Fragments of casters that leave their depth in a light's layer. The includer defines which forms it takes: DEPTH_MASKED, casters with
// alpha; DEPTH_PEEL, what lies behind the layer drawn before (Everitt 2001); DEPTH_WARPED, layers whose projection takes no affine depth to
// an affine depth, so that fragments write it; DEPTH_IDS, with the instance beside the depth.
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/light_depth.shared.h"
#ifdef DEPTH_MASKED
#include "src/shadow/parts/light_masked.glsl"
#endif

layout(location = 2) flat in int layer;

#ifdef DEPTH_WARPED
layout(location = 3) in float before_far;
layout(set = 1, binding = 0, scalar) uniform Constants { LightDepthConstants c; };

// stored_from_depth (shaders/light_map.glsl), with what polygon offset does to interpolated depth.
float stored_depth()
{
    const vec4 range = c.ranges[layer];
    const float scale = range.z != 0.0 ? range.x / max(range.y - before_far, 1e-20) : 1.0;
    const float z = before_far * scale / (range.y - range.x);
    // Rasterisers interpolate x / w and 1 / w to a part of their largest value in the map, where w is 1 (LightMapLayer): divided by the 1 / w
    // found here, the error grows with w. In stored depth, a part of the range of metres; of perspective layers, times dz / dmetres.
    const float rounding = 1e-6 / gl_FragCoord.w * (range.z != 0.0 ? scale * scale * range.y / range.x : 1.0);
    return clamp(z - range.w * max(abs(dFdx(z)), abs(dFdy(z))) - rounding, 0.0, 1.0);
}
#else
float stored_depth() { return gl_FragCoord.z; }
#endif

#ifdef DEPTH_IDS
layout(constant_id = 0) const bool masked = false;
layout(location = 4) flat in uint first_primitive;
layout(location = 0) out uint id;
#else
const bool masked = true;
#endif

#ifdef DEPTH_PEEL
layout(set = 0, binding = 2) uniform sampler2DArray before;

// The margin is that of reference_depth (shaders/light_map.glsl). It also keeps walls that are modelled twice from taking two layers.
bool behind(float z)
{
    const float nearer = texelFetch(before, ivec3(gl_FragCoord.xy, layer), 0).r;
    return z < nearer - max(4e-6 * nearer, 1e-7);
}
#endif

void main()
{
    const float z = stored_depth();
#ifdef DEPTH_PEEL
    if (!behind(z)) discard;
#endif
#ifdef DEPTH_MASKED
    if (masked && !caster_is_there()) discard;
#endif
#ifdef DEPTH_IDS
    id = first_primitive;
#endif
#ifdef DEPTH_WARPED
    gl_FragDepth = z;
#endif
}
