// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_PER_TRIANGLE_VOLUMES_SHARED_H
#define GNOMON_PER_TRIANGLE_VOLUMES_SHARED_H
#include "shaders/frame.shared.h"
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

TECHNIQUE_BEGIN(per_triangle_volumes)

struct Params {
    int cull DEFAULT(0); ///< CULL_*
    int team DEFAULT(0); ///< index into ballot, shared
    int queue DEFAULT(1048576);
    int blockers DEFAULT(0);
    float blocker_size DEFAULT(0.001f);
    int mode DEFAULT(0); ///< MODE_*
    int texture_level DEFAULT(0); ///< LEVEL_*
    int samples DEFAULT(0); ///< SAMPLES_*
};

/// What lies behind a triangle as seen from the light, as planes (a, b, c, d) over a sample's (x, y, z, 1) in normalised device
/// coordinates: inside where all four values are not negative.
struct Volume {
    vec4 side_0, side_1, side_2; ///< through the light and the edge opposite to each corner
    vec4 cap; ///< the triangle's own plane
    vec3 line_0, line_1, line_2, line_3; ///< over (x, y, 1): negative beyond lines in the picture that the volume does not cross
    uint primitive;
    uint slot; ///< of the instance, times 16, and VOLUME_*
    uint padding[2];
};
#define VOLUME_WORDS 32
#define VOLUME_OPEN 1u ///< << i: side i excludes its own plane, which belongs to the triangle on the other side
#define VOLUME_MASKED 8u

/// Nodes of this height, 32 x 32 samples, are where the first pass leaves off and the second begins.
#define LISTED_HEIGHT 2
#define PHASE_EXPAND 0
#define PHASE_DRAIN 1

#define WHICH_ALL 0
#define WHICH_LARGE 1
#define WHICH_OTHERS 2

#define CULL_NONE 0
#define CULL_FRONT 1
#define CULL_BACK 2

#define MODE_BINARY 0
#define MODE_ALPHA 1
#define MODE_RGB 2
#define MODE_TEXTURED 3
#define MODE_STOCHASTIC 4

#define SAMPLES_ONE 0
#define SAMPLES_FOUR 1
#define SAMPLES_SIXTEEN 2
#define SAMPLES_EXTRAPOLATED 3

#define LEVEL_FOOTPRINT 0
#define LEVEL_FINEST 1

/// Of one frame.
struct Counts {
    uint triangles, triangles_culled; ///< looked at; of them those that reach no sample
    uint tile_tests, sample_tests;
    uint queue_entries; ///< nodes at which the second pass goes on
    uint blocks_culled;
};

struct TreeConstants {
    View view;
    Light light;
    Tree tree;
};

struct VolumeConstants {
    Light light;
    Tree tree;
    mat4 world_from_ndc; ///< homogeneous, relative to `eye`
    vec3 eye;
    uint cull; ///< CULL_*
    vec4 eye_point; ///< homogeneous, relative to `eye`: itself, or where an orthographic view looks
    float ray; ///< longest of the rays through the picture, in metres at unit depth
    uint first_block, blocks; ///< casters of this round
    uint which; ///< WHICH_*
    float large; ///< how much of the light's view makes a triangle a large one
};

struct ClearConstants {
    Tree tree;
    uint frame; ///< the seed of MODE_STOCHASTIC
    uint texture_level; ///< LEVEL_*
    uvec2 side_log2; ///< of a pixel's samples right and down
};

SHARED_END

#endif
