// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_SHADERS_N_BUFFER_SHARED_H
#define GNOMON_SHADERS_N_BUFFER_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

/// How the windows lie in an image array: those of 2^level texels a side of a map's layer are in image layer `level * layers + layer`.
struct NBuffer {
    int layers; ///< of the map
    int levels;
    int centred; ///< 0: texel x holds the window [x, x + 2^level); 1: [x - 2^level / 2, x + 2^level / 2), of one texel at level 0
    int coarseness; ///< texels of the buffer are 2^coarseness of the map's wide (Y maps; else 0)
};

SHARED_END

#endif
