// SPDX-License-Identifier: Apache-2.0
// Glue for headers read by both C++ and GLSL (*.shared.h). Scalar layout on both sides: every member is made of 4-byte words.
#ifndef GNOMON_SHADERS_SHARED_H
#define GNOMON_SHADERS_SHARED_H

#ifdef __cplusplus
#include "scene/math.h"
#include <cstdint>
#define SHARED_BEGIN(name)                                                                                                                 \
    namespace gnomon::shaders {                                                                                                            \
    using uint = uint32_t;
#define TECHNIQUE_BEGIN(id)                                                                                                                \
    namespace gnomon::techniques::id {                                                                                                     \
    using namespace gnomon::shaders;
#define SHARED_END }
#define DEFAULT(value) = value
#else
#extension GL_EXT_scalar_block_layout : require
#define SHARED_BEGIN(name)
#define TECHNIQUE_BEGIN(id)
#define SHARED_END
#define DEFAULT(value)
#endif

#endif
