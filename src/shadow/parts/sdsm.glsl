// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SDSM_GLSL
#define GNOMON_SDSM_GLSL
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/ordered_float.glsl"
#include "src/shadow/parts/sdsm.shared.h"

bool any_sample(SampleBounds b) { return b.least[0] != ~0u; }
float least(SampleBounds b, int k) { return float_from_ordered(b.least[k]); }
float most(SampleBounds b, int k) { return -float_from_ordered(b.least_negated[k]); }

#endif
