// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "truth/truth.h"

namespace gnomon::truth {

/// What Embree alone needs for the rays of a picture with a hard light: packets made beforehand, only traversal timed, the best
/// of three runs. The yardstick for `primary` and `visibility`, which must stay within 1.5 times the sum.
struct RawThroughput {
    double primary_ms = 0, shadow_ms = 0;
    uint64_t primary_rays = 0, shadow_rays = 0;
};
RawThroughput raw_packets(const Tracer&, const scene::View&, const scene::Light&, int threads = 0);

} // namespace gnomon::truth
