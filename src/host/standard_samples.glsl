// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_HOST_STANDARD_SAMPLES_GLSL
#define GNOMON_HOST_STANDARD_SAMPLES_GLSL

// Where sample 0 lies in a pixel: Vulkan's standard sample locations.
vec2 first_sample(int count)
{
    switch (count) {
    case 2: return vec2(0.75, 0.75);
    case 4: return vec2(0.375, 0.125);
    case 8: return vec2(0.5625, 0.3125);
    case 16: return vec2(0.5625, 0.5625);
    }
    return vec2(0.5);
}
#endif
