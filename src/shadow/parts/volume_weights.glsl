// SPDX-License-Identifier: Apache-2.0
// What one crossing of a volume's face adds to a pixel.
#ifndef GNOMON_VOLUME_WEIGHTS_GLSL
#define GNOMON_VOLUME_WEIGHTS_GLSL

// Sums of logarithms beside the count: in units so coarse that float sums of them are exact, whatever the order (volumes.shared.h).
layout(constant_id = 0) const bool COLOURED = false;

vec4 weight_of(ivec4 of_slot, int times) { return COLOURED ? vec4(of_slot * times) : vec4(times); }

#endif
