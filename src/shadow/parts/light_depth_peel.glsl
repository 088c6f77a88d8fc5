// SPDX-License-Identifier: Apache-2.0
// Depth peeling (Everitt 2001): what lies behind the layer drawn before.
layout(location = 2) flat in int layer;
layout(set = 0, binding = 2) uniform sampler2DArray before;

// The margin is that of reference_depth (shaders/light_map.glsl). It also keeps walls that are modelled twice from taking two layers.
bool behind()
{
    const float nearer = texelFetch(before, ivec3(gl_FragCoord.xy, layer), 0).r;
    return gl_FragCoord.z < nearer - max(4e-6 * nearer, 1e-7);
}
