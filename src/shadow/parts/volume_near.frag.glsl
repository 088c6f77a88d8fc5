// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) flat in vec4 weight;

layout(location = 0) out vec4 change;

void main() { change = weight; }
