// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_ARB_shader_viewport_layer_array : require

layout(location = 0) in vec3 position;

void main()
{
    gl_Position = vec4(position.x, -position.y, position.z * float(gl_InstanceIndex + 1), 1.0);
    gl_Layer = gl_InstanceIndex;
}
