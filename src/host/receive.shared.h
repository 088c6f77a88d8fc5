// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_HOST_RECEIVE_SHARED_H
#define GNOMON_HOST_RECEIVE_SHARED_H
#include "shaders/frame.shared.h"

SHARED_BEGIN(shaders)

#define NORMALS_NONE 8 ///< else gnomon_frame::normal_encoding
#define NORMALS_GEOMETRIC 4

struct ReceiveConstants {
    View view; ///< Gnomon's, of the same pixels
    vec4 depth_row, w_row; ///< view depth = dot(depth_row, p) / dot(w_row, p) at the host's clip p = (x, y, depth - background, 1)
    vec4 normal_x, normal_y, normal_z; ///< rows of world from host, for directions
    float background; ///< the host's depth where nothing is
    uint normals; ///< encoding
};

SHARED_END

#endif
