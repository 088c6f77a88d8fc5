// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures.shared.h"

#define CASTER_CONSTANTS DrawConstants
#include "src/shadow/parts/light_casters.glsl"
