// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_scalar_block_layout : require

layout(set = 0, binding = 0) uniform accelerationStructureEXT scene;
layout(set = 0, binding = 1, r32f) writeonly uniform image2D picture;
layout(set = 1, binding = 0, scalar) uniform Constants { float scale; };
layout(location = 0) rayPayloadEXT float hit;

void main()
{
    const vec2 ndc = (vec2(gl_LaunchIDEXT.xy) + 0.5) / vec2(gl_LaunchSizeEXT.xy) * 2.0 - 1.0;
    hit = -1.0;
    traceRayEXT(scene, gl_RayFlagsNoneEXT, 0xff, 0, 1, 0, vec3(ndc.x, -ndc.y, 5.0), 0.0, vec3(0.0, 0.0, -1.0), 100.0, 0);
    imageStore(picture, ivec2(gl_LaunchIDEXT.xy), vec4(hit * scale));
}
