// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"
#include "src/shadow/gbuffer.shared.h"

layout(location = 0) in vec3 position;
layout(location = 4) in vec3 previous_position;

layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 1, scalar) readonly buffer PreviousInstances { Instance previous_instances[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { GBufferConstants c; };

layout(location = 0) out vec3 clip_previous;
layout(location = 1) out vec3 clip_now;

invariant gl_Position;

void main()
{
    const uint slot = instance_slot(gl_InstanceIndex);
    const vec3 p_world = transform_point(instances[slot], position);
    gl_Position = c.view.clip_from_world * vec4(p_world, 1.0);
    clip_now = gl_Position.xyw;
    clip_previous = (c.previous_clip_from_world * vec4(transform_point(previous_instances[slot], previous_position), 1.0)).xyw;
}
