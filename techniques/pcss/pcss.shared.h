// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_PCSS_SHARED_H
#define GNOMON_PCSS_SHARED_H
#include "shaders/soft_map.shared.h"

#define PCSS_GRID 0
#define PCSS_POISSON 1
#define PCSS_VOGEL 2
#define PCSS_RECEIVER_PLANE 0
#define PCSS_CONE 1
#define PCSS_SHORTCUT_NONE 0
#define PCSS_SHORTCUT_LIT 1
#define PCSS_SHORTCUT_BOTH 2
#define PCSS_FILTER_PCF 0
#define PCSS_FILTER_SUMS 1
#define PCSS_MAX_SEARCH_TAPS 64
#define PCSS_MAX_FILTER_TAPS 128

TECHNIQUE_BEGIN(pcss)

struct Params {
    SoftParams soft;
    int pattern DEFAULT(2);
    int search_taps DEFAULT(32);
    int filter_taps DEFAULT(64);
    int rotation DEFAULT(2);
    int refine DEFAULT(3);
    int centred DEFAULT(1);
    int filtering DEFAULT(0);
    int shortcut DEFAULT(2);
    int receiver DEFAULT(1);
    float bias_cone DEFAULT(1.0f);
    float least DEFAULT(1.0f);
    int cap DEFAULT(128);
};

struct ResolveConstants {
    SoftResolve soft;
    Params params; ///< taps and cap as in use
    float sum_step; ///< PCSS_FILTER_SUMS: value of one count
    vec2 search[PCSS_MAX_SEARCH_TAPS]; ///< unit disk, or for rectangles [-1, 1]^2
    vec2 taps[PCSS_MAX_FILTER_TAPS]; ///< the same, for the filter
};

SHARED_END

#endif
