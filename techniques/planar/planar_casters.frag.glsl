// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/planar/planar.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { CasterConstants c; };
layout(location = 0) out float kept;

void main() { kept = c.kept; }
