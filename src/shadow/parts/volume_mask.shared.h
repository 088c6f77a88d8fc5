// SPDX-License-Identifier: Apache-2.0
// Blocks of the passes of parts/volume_culling.h.
#ifndef GNOMON_VOLUME_MASK_SHARED_H
#define GNOMON_VOLUME_MASK_SHARED_H
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"
#include "shaders/n_buffer.shared.h"

/// Texels a side of a layer's mask of receivers.
#define VOLUME_MASK_SIZE 256
/// Threads of a group, which takes one slot.
#define VOLUME_CULL_GROUP 64

SHARED_BEGIN(shaders)

/// The receivers that are seen through a texel.
struct VolumeTexel {
    uint reach; ///< ordered_from_float of the greatest depth, along the layer's axis, at which a caster may still darken one of them; 0:
                ///< none
    uint bands; ///< a bit for each band in which one is seen
};

struct VolumeMaskConstants {
    View view;
    Light light;
    LightMap map;
    NBuffer windows;
    uint axis; ///< bands are columns (0) or rows (1) of pixels
    uint bands;
    uint slots;
};

SHARED_END

#endif
