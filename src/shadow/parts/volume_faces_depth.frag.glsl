// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volumes.shared.h"

layout(early_fragment_tests) in; // what the depth test fails is neither shaded nor counted

layout(constant_id = 1) const bool COUNTED = false;

layout(set = 0, binding = 3, scalar) buffer Work { VolumeWork work; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

layout(location = 2) flat in vec4 weight;

layout(location = 0) out vec4 change;

void main()
{
    if (COUNTED) {
        atomicAdd(work.fragments, 1);
        atomicAdd(work.updates, 1);
    }
    change = gl_FrontFacing != (c.count == VOLUME_ZFAIL) ? weight : -weight;
}
