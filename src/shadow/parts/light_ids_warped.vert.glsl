// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/light_depth.shared.h"

#define CASTER_CONSTANTS LightDepthConstants
#define CASTERS_MASKED
#define CASTERS_IDS
#define CASTERS_WARPED
#include "src/shadow/parts/light_casters.glsl"
