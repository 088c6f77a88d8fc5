// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_ray_tracing : require
#include "shaders/scene.glsl"

hitAttributeEXT vec2 barycentric;

layout(set = 0, binding = 4, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"

void main()
{
    if (!mask_keeps(gl_InstanceCustomIndexEXT, gl_PrimitiveID, barycentric)) ignoreIntersectionEXT;
}
