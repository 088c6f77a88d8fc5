// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_ARB_shader_viewport_layer_array : require

layout(location = 0) flat out int layer;

// As fullscreen.vert, a layer an instance.
void main()
{
    gl_Position = vec4(vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2) * 2.0 - 1.0, 0.0, 1.0);
    gl_Layer = layer = gl_InstanceIndex;
}
