// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_VIRTUAL_SHADOW_MAP_SHARED_H
#define GNOMON_VIRTUAL_SHADOW_MAP_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

#define VIRTUAL_LEVELS 18 // at most
#define VIRTUAL_NO_PAGE 0xffffffffu // as Slot::page.x
#define VIRTUAL_RUN 256 // table entries that one invocation looks through for new pages
#define VIRTUAL_SHOW_LEVEL 1
#define VIRTUAL_SHOW_FOOTPRINT 2
// and, for inspections alone
#define VIRTUAL_INSPECT_PAGE 3
#define VIRTUAL_INSPECT_LEVEL 4

TECHNIQUE_BEGIN(virtual_shadow_map)

struct Params {
    int virtual_size DEFAULT(5); ///< 1024 << virtual_size
    int finer_levels DEFAULT(9);
    int page DEFAULT(1); ///< 64 << page
    int pool_pages DEFAULT(1024);
    float footprint DEFAULT(1.0f);
    float grazing DEFAULT(2.0f); ///< degrees
    int pcf DEFAULT(3);
    int bilinear DEFAULT(1);
    float bias_constant DEFAULT(0.0f);
    float bias_cone DEFAULT(1.0f);
    float slope_limit DEFAULT(16.0f);
    int cache DEFAULT(1);
    int show DEFAULT(0);
};

/// Level k of a face has 2^k pages a side, of which `side` are in the table at a time: those from (window_x, window_y) on.
struct Level {
    uint first; ///< entry of the table
    int side; ///< a power of two
    int window_x, window_y;
};

/// The virtual maps of one light: for each face, a map of one page and maps of twice the size each.
struct Grid {
    uint layout_kind; ///< LIGHT_MAP_SINGLE or LIGHT_MAP_CUBE
    int faces;
    int levels;
    int page; ///< texels a side, without borders
    int border; ///< texels around a page, drawn for the filter
    int pool; ///< pages that have memory
    uint face_entries, entries; ///< of the page table
    vec3 centre; ///< of the cube
    vec2 offset; ///< a face's uv less what its matrix gives: a multiple of 1/8, so that coordinates near the axes' origin keep their bits
    Level level[VIRTUAL_LEVELS];
    LightMapLayer face[6]; ///< with texels of the coarsest level
};

/// Counts of one frame, and what indirect draws read.
struct Counts {
    uint clear_vertices, fresh, clear_first_vertex, clear_first_instance; ///< a VkDrawIndirectCommand; fresh: pages drawn in this frame
    uint coarser; ///< levels by which every request is lowered, so that all fit into the pool
    uint kept; ///< of those needed, drawn in an earlier frame
    uint pairs; ///< of a page and a cluster of triangles drawn into it
    uint requested[VIRTUAL_LEVELS]; ///< pages that samples would use with requests lowered by so many levels; [coarser] is what they use
};

/// What is in a layer of the pool.
struct Slot {
    uvec2 page; ///< page_id
    uint used; ///< frame in which it was last needed
};

/// A page to be drawn.
struct PageDraw {
    vec4 planes[4]; ///< inside where dot(plane, (p, 1)) >= 0
    uint slot, face;
    float scale, x, y; ///< clip.xy = scale * map.xy + (x, y) * map.w
};

/// Triangles that are culled together: a part of an instance.
struct Cluster {
    vec3 centre; ///< of a box in the world
    uint first_index;
    vec3 extent; ///< half its sides
    uint index_count;
    int first_vertex;
    uint instance; ///< its slot in the scene's instances
};

struct Box {
    vec3 centre, extent;
};

struct RequestConstants {
    View view;
    Light light;
    Grid grid;
    float footprint; ///< pixels
    float least_sine; ///< of the angle between a receiver and the light
};

struct PageConstants {
    Grid grid;
    uint frame; ///< of this object, from 1
    uint moved; ///< boxes in which something moved
};

struct CullConstants {
    uint clusters;
    uint first_page, page_count; ///< of the fresh ones
};

struct DrawConstants {
    Grid grid;
};

struct ResolveConstants {
    View view;
    Light light;
    Grid grid;
    Params params;
};

SHARED_END

#endif
