// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) in vec3 clip_previous;
layout(location = 1) in vec3 clip_now;
layout(location = 0) out vec2 motion;

void main()
{
    motion = 0.5 * (clip_now.xy / clip_now.z - clip_previous.xy / clip_previous.z);
}
