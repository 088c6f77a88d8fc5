// SPDX-License-Identifier: Apache-2.0
// What all passes that take volumes down the tree are given (traversal.cpp); from binding 12 on they have their own.
#ifndef GNOMON_TRAVERSE_BINDINGS_GLSL
#define GNOMON_TRAVERSE_BINDINGS_GLSL
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/scene.glsl"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D primitive_image;
layout(set = 0, binding = 2, scalar) buffer Words { uint words[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Tiles { uint tiles[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Volumes { uint volume_words[]; }; // VOLUME_WORDS a volume
layout(set = 0, binding = 5, scalar) buffer Work { uint made, listed, kept; }; // volumes, entries, blocks of triangles
layout(set = 0, binding = 6, scalar) buffer Entries { uvec2 entries[]; }; // volume << 1 | inside, node
layout(set = 0, binding = 7, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 8, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 10, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 0, binding = 11, scalar) buffer Counting { Counts counts; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "techniques/per_triangle_volumes/team.glsl"

#endif
