// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VOLUMES_SHARED_H
#define GNOMON_VOLUMES_SHARED_H
#include "shaders/frame.shared.h"
#include "src/shadow/parts/volume_culling.shared.h"

#define VOLUME_GROUP 64
// VolumeEdge::second
#define VOLUME_ALONE 0xffffffffu
#define VOLUME_LIST 0x80000000u
// VolumeTask::edges
#define VOLUME_EDGES_CLOSED 0
#define VOLUME_EDGES_BERGERON 1
#define VOLUME_EDGES_ANY 2
// VolumeTask::count
#define VOLUME_ZPASS 0
#define VOLUME_ZFAIL 1
#define VOLUME_ZP_PLUS 2
#define VOLUME_PP_ZP 3
// What a draw of faces draws, by its first instance.
#define VOLUME_QUADS 0
#define VOLUME_NEAR_CAPS 1
#define VOLUME_FAR_CAPS 2
#define VOLUME_DRAWS 3
// Logarithms to the base 2 are counted in these parts, down to the clearest that is told from opaque: 2^24 of them add up exactly, which
// are 128 crossings of the darkest.
#define VOLUME_LOG_PARTS 8192
#define VOLUME_LEAST_LOG -16

SHARED_BEGIN(shaders)

/// An edge of a mesh with the triangles beside it: each (triangle << 1) + (1 where it runs through the edge backwards).
struct VolumeEdge {
    uint from, to; ///< vertices of the mesh
    uint first; ///< triangle
    uint second; ///< triangle; VOLUME_ALONE; or VOLUME_LIST + count: triangles from list[first] on
};

/// Some triangles or edges of one instance, for a group of a compute pass.
struct VolumeBlock {
    uint slot; ///< of the instance
    uint first, count; ///< triangles of its mesh; or edges in the buffer of all
    uint flags; ///< VOLUME_UNSEEN, VOLUME_ONE_SIDED
};
#define VOLUME_UNSEEN 1u // its triangles may not be in the G-buffer
#define VOLUME_ONE_SIDED 2u // nor those of it that are turned away from the eye

/// A quad from an edge away from the light.
struct VolumeQuad {
    vec3 from, to; ///< world
    int weight; ///< how many triangles' sides it stands for; its front is that of (to, from, from at infinity) where positive
    uint slot;
};

/// A triangle that closes a volume.
struct VolumeCap {
    vec3 a, b, c; ///< world; counter-clockwise seen from the light
    int weight;
    uint slot;
};

/// What is counted where a frame's counters are asked for.
struct VolumeWork {
    uint updates, fragments, quads, caps;
};

struct VolumeTask {
    View view;
    Light light;
    uint first_block, blocks;
    uint edges; ///< VOLUME_EDGES_*
    uint count; ///< VOLUME_ZPASS ...
    uint far_caps; ///< 0 or 1
    uint along_view; ///< 1 where all of the light's rays are those of the eye: quads are lines, and far caps right behind near ones
    VolumeBands bands; ///< none: count 0
};

SHARED_END

#endif
