// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#define CLIPPED
#include "src/shadow/parts/volume_faces.glsl"
