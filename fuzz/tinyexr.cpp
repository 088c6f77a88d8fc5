// SPDX-License-Identifier: Apache-2.0
// The library's own code, so that the sanitizers see into it; the linker takes this before the packaged one.
#include <zlib.h>

#define TINYEXR_IMPLEMENTATION
#include <tinyexr.h>
