// SPDX-License-Identifier: Apache-2.0
// The beginning of every technique that takes a light for its centre: what needs no look at a map.
#ifndef GNOMON_HARD_RECEIVER_GLSL
#define GNOMON_HARD_RECEIVER_GLSL
#include "shaders/light.glsl"
#include "shaders/receiver.glsl"

// False where `visibility` is already the answer: 1 on the background, 0 where the surface is turned away from the light or outside its cone.
bool find_hard_receiver(
    View view, Light light, sampler2D depth_image, usampler2D normal_image, vec2 pixel, out Receiver r, out float visibility)
{
    r = load_receiver(view, depth_image, normal_image, pixel);
    visibility = r.background ? 1.0 : 0.0;
    return !r.background && faces_light(light, r.p_world, r.n_geometric) && light_reaches(light, r.p_world);
}

#endif
