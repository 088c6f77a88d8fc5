// SPDX-License-Identifier: Apache-2.0
#version 460

layout(local_size_x_id = 3, local_size_y = 2) in;
layout(set = 0, binding = 0, std430) buffer Out { uint count; };

void main() { atomicAdd(count, 1u); }
