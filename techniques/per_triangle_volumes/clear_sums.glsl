// SPDX-License-Identifier: Apache-2.0
// What semitransparent triangles take from a sample, as sums of -log2(transmittance). Fixed point, so that they are the same in whatever
// order triangles come; 24 bits after the point are finer than a float's. They stop at a limit that stands for 0: whatever more comes
// changes nothing, and nothing wraps around.
#ifndef GNOMON_CLEAR_SUMS_GLSL
#define GNOMON_CLEAR_SUMS_GLSL

const uint SUM_LIMIT = 32u << 24;

uint sum_of(float transmittance) { return transmittance <= 0.0 ? SUM_LIMIT : min(uint(round(-log2(min(transmittance, 1.0)) * 16777216.0)), SUM_LIMIT); }

float transmittance_of(uint sum) { return sum >= SUM_LIMIT ? 0.0 : exp2(-float(sum) * (1.0 / 16777216.0)); }

// Of two sums within the limit.
uint saturated(uint a, uint b) { return min(a + b, SUM_LIMIT); }

float grey(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

#endif
