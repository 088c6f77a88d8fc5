// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "apps/view/ui.shared.h"

layout(set = 0, binding = UI_FONT) uniform sampler2D font;
layout(set = 0, binding = UI_CANVAS) uniform sampler2D canvas;
layout(set = 0, binding = UI_INSETS) uniform sampler2D insets;

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 2) in flat int fill;
layout(location = 0) out vec4 out_color;

void main()
{
    if (fill == UI_FONT) out_color = color * vec4(1.0, 1.0, 1.0, textureLod(font, uv, 0.0).r);
    else if (fill == UI_CANVAS) out_color = vec4(color.rgb * textureLod(canvas, uv, 0.0).rgb, color.a);
    else out_color = vec4(color.rgb * textureLod(insets, uv, 0.0).rgb, color.a);
}
