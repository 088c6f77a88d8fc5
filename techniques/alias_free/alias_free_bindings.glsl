// SPDX-License-Identifier: Apache-2.0
// What the passes over casters share. The fragment shader includes it too, without the geometry.
#ifndef GNOMON_ALIAS_FREE_BINDINGS_GLSL
#define GNOMON_ALIAS_FREE_BINDINGS_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/scene.glsl"
#include "techniques/alias_free/alias_free.shared.h"
#include "techniques/alias_free/alias_free_cells.glsl"

layout(set = 0, binding = 0, scalar) buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};
layout(set = 0, binding = 1, scalar) readonly buffer Records { vec4 records[]; };
layout(set = 0, binding = 2, scalar) buffer Blocked { uint blocked[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { GridConstants c; };

#endif
