// SPDX-License-Identifier: Apache-2.0
// The shape of a tree over a picture's samples with 32 children a node. A node of height k covers 8 x 4, 32 x 32, 256 x 128, 1024 x 1024,
// ... samples for k = 1, 2, 3, 4: children lie 8 x 4 in nodes of odd height and 4 x 8 in those of even height. Samples have height 0. Nodes
// that would lie outside of the picture do not exist.
#ifndef GNOMON_DEPTH_TREE_SHARED_H
#define GNOMON_DEPTH_TREE_SHARED_H
#include "shaders/shared.h"

#define TREE_MAX_HEIGHT 7 ///< 262144 x 131072 samples

SHARED_BEGIN(shaders)

struct Tree {
    uvec2 samples; ///< width and height; several samples a pixel are a larger picture
    uvec2 spread; ///< logarithms of the samples a pixel right and down that share its depth and slopes; else 0
    vec2 step; ///< half of the distance from a sample to the next, in normalised device coordinates
    vec3 nearer; ///< tree.glsl's receiver_depth, by powers of the depth
    uint height; ///< of the root
    uint nodes; ///< of all heights from 1 on
    uint first[TREE_MAX_HEIGHT + 1]; ///< of a height's nodes, which are stored by rows
    uint width[TREE_MAX_HEIGHT + 1]; ///< nodes in a row
};

/// Both logarithms of the samples that a node covers.
#ifdef __cplusplus
inline uvec2 tree_shift(uint height) { return uvec2((5 * height + 1) / 2, 5 * height / 2); }
#else
uvec2 tree_shift(uint height) { return uvec2((5 * height + 1) / 2, 5 * height / 2); }
#endif

SHARED_END

#endif
