// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_GBUFFER_SHARED_H
#define GNOMON_GBUFFER_SHARED_H
#include "shaders/frame.shared.h"

SHARED_BEGIN(shaders)

struct GBufferConstants {
    View view;
    mat4 previous_clip_from_world; ///< motion only
};

SHARED_END

#endif
