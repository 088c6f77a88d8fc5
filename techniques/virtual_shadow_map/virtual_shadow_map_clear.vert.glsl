// SPDX-License-Identifier: Apache-2.0
// One triangle over the layer of each new page, at depth 0: nothing there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(set = 0, binding = 0, scalar) readonly buffer Pages { PageDraw pages[]; };

void main()
{
    gl_Layer = int(pages[gl_InstanceIndex].slot);
    gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
