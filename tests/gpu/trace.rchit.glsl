// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 0) rayPayloadInEXT float hit;

void main() { hit = 1.0 + float(gl_InstanceCustomIndexEXT); }
