// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) in vec3 position;

// As under a projection that flips y: world y is up, Vulkan's clip y is down.
void main() { gl_Position = vec4(position.x, -position.y, position.z, 1.0); }
