// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volumes.shared.h"

layout(local_size_x = VOLUME_DRAWS) in;

struct Draw {
    uint vertices, instances, first_vertex, first_instance;
};
layout(set = 0, binding = 0, scalar) writeonly buffer Draws { Draw draws[]; };

void main() { draws[gl_LocalInvocationIndex] = Draw(0, 1, 0, gl_LocalInvocationIndex); }
