// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/cssm/cssm.shared.h"

#define SAMPLER usampler2DArray
#include "shaders/summed_area_table.glsl"
#include "techniques/cssm/cssm_resolve.glsl"

vec4 window_value(usampler2DArray values, int layer, vec2 lo, vec2 hi) { return window_mean(values, layer, lo, hi, c.prefiltered.sum_step); }
