// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "apps/view/ui.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { UiConstants c; };

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;

layout(location = 0) out vec2 uv_out;
layout(location = 1) out vec4 color_out;
layout(location = 2) out flat int fill;

void main()
{
    gl_Position = vec4(c.scale * position + c.offset, 0.0, 1.0);
    uv_out = uv, color_out = color;
    fill = gl_InstanceIndex; // a draw's first instance says what it is filled from
}
