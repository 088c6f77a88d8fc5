// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#define DEPTH_MASKED
#define DEPTH_IDS
#define DEPTH_WARPED
#include "src/shadow/parts/light_depth_fragment.glsl"
