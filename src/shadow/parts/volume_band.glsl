// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VOLUME_BAND_GLSL
#define GNOMON_VOLUME_BAND_GLSL

// The band of a pixel, as volume_bands (parts/volume_culling.cpp) places their planes.
uint band_of(uvec2 pixel, vec2 size, uint axis, uint bands) { return min(pixel[axis] * bands / uint(size[axis]), bands - 1u); }

#endif
