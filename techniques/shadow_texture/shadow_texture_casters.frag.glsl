// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) out float lit;

void main() { lit = 0.0; }
