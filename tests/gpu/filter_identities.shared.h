// SPDX-License-Identifier: Apache-2.0
// One window of depths, and what each prefiltered technique makes of it.
#ifndef GNOMON_TESTS_FILTER_IDENTITIES_SHARED_H
#define GNOMON_TESTS_FILTER_IDENTITIES_SHARED_H
#include "shaders/shared.h"

SHARED_BEGIN(shaders)

struct WindowCase {
    int first; ///< of (centred depth, weight) in the list of all windows
    int count;
    float t; ///< receiver, centred depth
    float exponent DEFAULT(40.0f); ///< of evsm and esm
    float negative_exponent DEFAULT(10.0f);
    float min_deviation DEFAULT(0.0f); ///< centred depth
    float moment_bias DEFAULT(0.0f); ///< share
    int terms DEFAULT(8); ///< of csm, even
    int bits DEFAULT(0); ///< of csm's sines and cosines and of their mean; 0: floats
    float attenuation DEFAULT(0.0f);
    int layers DEFAULT(1); ///< of lvsm, all alike
    float overlap DEFAULT(0.0f);
};

struct WindowResult {
    float vsm, evsm2, evsm4;
    float msm; ///< from the moments
    float msm_quantised; ///< from the moments in the basis for fixed point, in floats
    float esm, esm_log;
    float csm; ///< not scaled, not cut off
    float lvsm;
    float power;
    vec4 moments;
    vec4 quantised; ///< in the basis for fixed point
    vec4 returned; ///< moments from them
};

SHARED_END

#endif
