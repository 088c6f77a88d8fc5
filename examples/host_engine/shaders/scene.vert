// SPDX-License-Identifier: Apache-2.0
#version 460
// Depth and lit passes compare depths for equality.
invariant gl_Position;

struct Instance {
    vec4 rows[3]; // host space from object
    vec4 color;
};
layout(std430, set = 0, binding = 0) readonly buffer Instances { Instance instances[]; };
layout(push_constant) uniform Push { mat4 clip_from_host; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec3 p_host;
layout(location = 1) out vec3 n_host;
layout(location = 2) out vec2 uv_out;
layout(location = 3) flat out vec4 color;

void main()
{
    const Instance i = instances[gl_InstanceIndex];
    const vec4 p = vec4(position, 1);
    p_host = vec3(dot(i.rows[0], p), dot(i.rows[1], p), dot(i.rows[2], p));
    n_host = vec3(dot(i.rows[0].xyz, normal), dot(i.rows[1].xyz, normal), dot(i.rows[2].xyz, normal)); // scales are uniform
    uv_out = uv;
    color = i.color;
    gl_Position = clip_from_host * vec4(p_host, 1);
}
