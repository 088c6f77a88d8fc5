// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_OCCLUSION_TEXTURES_SHARED_H
#define GNOMON_OCCLUSION_TEXTURES_SHARED_H
#include "shaders/n_buffer.shared.h"
#include "shaders/soft_map.shared.h"

#define PLACE_UNIFORM 0
#define PLACE_LOGARITHMIC 1
#define PLACE_FITTED 2

#define PREFILTER_SUMS 0
#define PREFILTER_N_BUFFER 1
#define PREFILTER_MIPS 2

#define FUSE_PRODUCT 0
#define FUSE_SUM 1
#define FUSE_MAX 2
#define FUSE_MEAN 3
#define FUSE_JOINED 4

#define OWN_NONE 0
#define OWN_COMPARE 1

#define SLICES_MAX 16
#define SLICE_GROUPS 4 ///< of four slices, the channels of an image

TECHNIQUE_BEGIN(occlusion_textures)

struct Params {
    SoftParams soft;
    int slices DEFAULT(8);
    int placement DEFAULT(PLACE_FITTED);
    int middle DEFAULT(1);
    int prefilter DEFAULT(PREFILTER_SUMS);
    int fusion DEFAULT(FUSE_PRODUCT);
    int own DEFAULT(OWN_COMPARE);
    int equal_area DEFAULT(1);
};

/// Where the slices of each layer begin and end, in stored depth: group g of layer l at l * SLICE_GROUPS + g. Those that hold nothing lie
/// behind everything, at -1.
struct Slices {
    vec4 near[LIGHT_MAP_MAX_LAYERS * SLICE_GROUPS];
    vec4 far[LIGHT_MAP_MAX_LAYERS * SLICE_GROUPS];
};

struct DrawConstants {
    mat4 clip_from_world[LIGHT_MAP_MAX_LAYERS];
    Slices slices;
    vec3 front[LIGHT_MAP_MAX_LAYERS]; ///< content is where dot(front, (u, v, 1)) >= 0: before the plane of a rectangle or disk
    float size; ///< texels a side
};

/// Where group g of a layer lies in the image of slices: at g * layers + layer.
struct GroupConstants {
    int layers;
    int groups;
    int joined; ///< whether slices are to cover what nearer ones do
};

struct ResolveConstants {
    SoftResolve soft;
    Params params;
    Slices slices;
    NBuffer n_buffer;
    float kernel_scale; ///< of the window's half width: to the area of a round light, or 1
};

SHARED_END

#endif
