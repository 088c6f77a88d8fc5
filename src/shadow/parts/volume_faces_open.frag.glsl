// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require

// A stencil tells which pixels are to be counted: no fragment of another comes here.
layout(early_fragment_tests) in;

#include "src/shadow/parts/volume_faces_fragment.glsl"
