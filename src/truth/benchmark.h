// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "truth/truth.h"

namespace gnomon::truth {

/// What Embree alone needs for the rays of a picture with a hard light: packets made beforehand, only traversal timed, the best of
/// three runs. The yardstick for `primary` and `visibility`: 1.5 to 1.7 times the sum on two busy cores, with 100,000 triangles and
/// 1024x768 pixels; the rest goes into writing and reading the 32 bytes a pixel of Primary.
struct RawThroughput {
    double primary_ms = 0, shadow_ms = 0;
    uint64_t primary_rays = 0, shadow_rays = 0;
};
RawThroughput raw_packets(const Tracer&, const scene::View&, const scene::Light&, int threads = 0);

} // namespace gnomon::truth
